//! Settings of layers as a flat list, for serde.
//!
//! A hostile file could nest values until reading them overflows the stack. A flat list is read with a bound on the
//! depth.

use crate::setting::{NamedSettings, Setting};
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Deepest nesting of lists and objects that is read, with the outermost object counted. Settings of a valid document
/// nest at most 8 deep.
const DEEPEST: u32 = 16;

/// A simple value, or the start of a list or object. `List(n)` is followed by n values, `Object(n)` by n pairs of a text
/// and a value.
#[derive(Serialize, Deserialize)]
enum Token {
    Null,
    Bool(bool),
    Number(f64),
    Text(String),
    List(u32),
    Object(u32),
}

/// Writes settings as a flat list of tokens.
pub(crate) fn serialize<S: Serializer>(settings: &NamedSettings, serializer: S) -> Result<S::Ok, S::Error> {
    let mut tokens = Vec::new();
    add_object(settings, &mut tokens);
    tokens.serialize(serializer)
}

fn add_object(settings: &NamedSettings, tokens: &mut Vec<Token>) {
    tokens.push(Token::Object(settings.len() as u32));
    for (name, value) in settings {
        tokens.push(Token::Text(name.clone()));
        add(value, tokens);
    }
}

fn add(value: &Setting, tokens: &mut Vec<Token>) {
    match value {
        Setting::Null => tokens.push(Token::Null),
        Setting::Bool(truth) => tokens.push(Token::Bool(*truth)),
        Setting::Number(number) => tokens.push(Token::Number(*number)),
        Setting::Text(text) => tokens.push(Token::Text(text.clone())),
        Setting::List(items) => {
            tokens.push(Token::List(items.len() as u32));
            items.iter().for_each(|item| add(item, tokens));
        }
        Setting::Object(settings) => add_object(settings, tokens),
    }
}

/// Reads settings from a flat list of tokens. Fails if the list is not exactly one object, or if values nest too
/// deeply.
pub(crate) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<NamedSettings, D::Error> {
    let tokens = Vec::<Token>::deserialize(deserializer)?;
    read(tokens)
        .ok_or_else(|| D::Error::custom("the settings of a layer are not whole, or nested too deeply"))
}

fn read(tokens: Vec<Token>) -> Option<NamedSettings> {
    let mut tokens = tokens.into_iter();
    match value(&mut tokens, DEEPEST)? {
        Setting::Object(settings) if tokens.next().is_none() => Some(settings),
        _ => None,
    }
}

fn value(tokens: &mut impl Iterator<Item = Token>, deepest: u32) -> Option<Setting> {
    let below = deepest.checked_sub(1);
    Some(match tokens.next()? {
        Token::Null => Setting::Null,
        Token::Bool(truth) => Setting::Bool(truth),
        Token::Number(number) => Setting::Number(Some(number).filter(|number| number.is_finite())?),
        Token::Text(text) => Setting::Text(text),
        Token::List(count) => {
            Setting::List((0..count).map(|_| value(tokens, below?)).collect::<Option<_>>()?)
        }
        Token::Object(count) => {
            let pair = |_| match tokens.next()? {
                Token::Text(name) => Some((name, value(tokens, below?)?)),
                _ => None,
            };
            Setting::Object((0..count).map(pair).collect::<Option<_>>()?)
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tokens(settings: &NamedSettings) -> Vec<Token> {
        let mut tokens = Vec::new();
        add_object(settings, &mut tokens);
        tokens
    }

    #[test]
    fn every_kind_of_value_is_read_as_it_was_written() {
        let number = |number: f64| Setting::Number(number);
        let settings = vec![
            ("palette".to_owned(), Setting::List(vec![Setting::Text("#ff0000".into()), Setting::Null])),
            ("place".to_owned(), Setting::List(vec![number(-0.5), number(1e-9)])),
            (
                "masks".to_owned(),
                Setting::List(vec![Setting::Object(vec![("a".into(), Setting::Bool(true))])]),
            ),
            ("empty".to_owned(), Setting::Object(Vec::new())),
        ];
        assert_eq!(read(tokens(&settings)), Some(settings));
        assert_eq!(read(tokens(&Vec::new())), Some(Vec::new()));
    }

    #[test]
    fn what_is_not_whole_or_too_deep_is_refused() {
        assert_eq!(read(vec![]), None);
        assert_eq!(read(vec![Token::Null]), None);
        assert_eq!(read(vec![Token::Object(1), Token::Text("a".into())]), None);
        assert_eq!(read(vec![Token::Object(u32::MAX)]), None);
        assert_eq!(read(vec![Token::Object(0), Token::Null]), None);
        let deep = |levels: usize| {
            let lists = (0..levels).map(|_| Token::List(1));
            [Token::Object(1), Token::Text("a".into())]
                .into_iter()
                .chain(lists)
                .chain([Token::Null])
                .collect()
        };
        assert!(read(deep(8)).is_some());
        assert_eq!(read(deep(100_000)), None);
    }

    #[test]
    fn a_number_that_is_none_is_refused() {
        let tokens = [f64::NAN, f64::INFINITY]
            .map(|number| vec![Token::Object(1), Token::Text("a".into()), Token::Number(number)]);
        assert_eq!(tokens.map(read), [None, None]);
    }
}
