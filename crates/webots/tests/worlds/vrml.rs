//! Reads PROTO and world files: the part of VRML that they use.

use std::collections::BTreeMap;

/// A node with its fields.
#[derive(Clone, Debug, Default)]
pub struct Node {
    pub kind: String,
    /// Its `DEF` name.
    pub def: Option<String>,
    pub fields: BTreeMap<String, Value>,
}

/// The value of a field.
#[derive(Clone, Debug)]
pub enum Value {
    Numbers(Vec<f64>),
    Text(String),
    Flag(bool),
    Nodes(Vec<Node>),
    Texts(Vec<String>),
    /// Empty brackets.
    Empty,
    /// `USE name`.
    Use(String),
    /// `IS field`.
    Is(String),
}

/// The fields of a PROTO by their names, each with its type and default value.
pub type Interface = BTreeMap<String, (String, Value)>;

/// The contents of a file.
#[derive(Debug, Default)]
pub struct File {
    pub header: String,
    /// Addresses after `EXTERNPROTO`.
    pub externs: Vec<String>,
    /// A PROTO's name and its fields.
    pub proto: Option<(String, Interface)>,
    pub nodes: Vec<Node>,
}

struct Reader {
    tokens: Vec<String>,
    at: usize,
}

/// Reads a whole file. Panics if the file cannot be read.
pub fn read(text: &str) -> File {
    let header = text.lines().next().unwrap_or("").to_owned();
    let mut reader = Reader { tokens: tokens(text), at: 0 };
    let mut file = File { header, ..File::default() };
    while let Some(token) = reader.peek().map(str::to_owned) {
        match token.as_str() {
            "EXTERNPROTO" => {
                reader.next();
                file.externs.push(unquoted(&reader.next()));
            }
            "PROTO" => {
                reader.next();
                let name = reader.next();
                file.proto = Some((name, reader.interface()));
                reader.expect("{");
                file.nodes.push(reader.node());
                reader.expect("}");
            }
            _ => file.nodes.push(reader.node()),
        }
    }
    file
}

/// Splits a text into words, quoted texts and brackets, without comments.
fn tokens(text: &str) -> Vec<String> {
    let mut tokens = Vec::new();
    for line in text.lines() {
        let mut quoted = false;
        let mut word = String::new();
        for letter in line.chars() {
            match letter {
                '"' => {
                    quoted = !quoted;
                    word.push('"');
                }
                _ if quoted => word.push(letter),
                '#' => break,
                '{' | '}' | '[' | ']' => {
                    tokens.extend([std::mem::take(&mut word), letter.to_string()]);
                }
                ' ' | ',' | '\t' => tokens.push(std::mem::take(&mut word)),
                _ => word.push(letter),
            }
        }
        assert!(!quoted, "a text does not end: {line}");
        tokens.push(word);
    }
    tokens.retain(|token| !token.is_empty());
    tokens
}

fn unquoted(token: &str) -> String {
    token.trim_matches('"').to_owned()
}

impl Reader {
    fn peek(&self) -> Option<&str> {
        self.tokens.get(self.at).map(String::as_str)
    }

    fn next(&mut self) -> String {
        let token = self.tokens.get(self.at).cloned();
        self.at += 1;
        token.unwrap_or_else(|| panic!("the file ends too early"))
    }

    fn expect(&mut self, wanted: &str) {
        let found = self.next();
        assert_eq!(found, wanted, "at token {} of the file", self.at);
    }

    fn interface(&mut self) -> Interface {
        let mut fields = BTreeMap::new();
        self.expect("[");
        while self.peek() != Some("]") {
            let access = self.next();
            assert!(["field", "vrmlField"].contains(&access.as_str()), "'{access}' is no field of a PROTO");
            let (kind, name) = (self.next(), self.next());
            let default = self.value();
            assert!(fields.insert(name.clone(), (kind, default)).is_none(), "{name} stands twice");
        }
        self.expect("]");
        fields
    }

    fn node(&mut self) -> Node {
        let mut node = Node { kind: self.next(), ..Node::default() };
        if node.kind == "DEF" {
            node.def = Some(self.next());
            node.kind = self.next();
        }
        self.expect("{");
        while self.peek() != Some("}") {
            let name = self.next();
            let value = self.value();
            assert!(
                node.fields.insert(name.clone(), value).is_none(),
                "{name} stands twice in {}",
                node.kind
            );
        }
        self.expect("}");
        node
    }

    fn value(&mut self) -> Value {
        match self.peek().unwrap_or("") {
            "[" => self.list(),
            "IS" => {
                self.next();
                Value::Is(self.next())
            }
            "USE" => {
                self.next();
                Value::Use(self.next())
            }
            "TRUE" | "FALSE" => Value::Flag(self.next() == "TRUE"),
            token if token.starts_with('"') => Value::Text(unquoted(&self.next())),
            token if token.parse::<f64>().is_ok() => Value::Numbers(self.numbers()),
            _ => Value::Nodes(vec![self.node()]),
        }
    }

    fn numbers(&mut self) -> Vec<f64> {
        let mut numbers = Vec::new();
        while let Some(number) = self.peek().and_then(|token| token.parse().ok()) {
            numbers.push(number);
            self.at += 1;
        }
        numbers
    }

    fn list(&mut self) -> Value {
        self.expect("[");
        let value = match self.peek().unwrap_or("") {
            "]" => Value::Empty,
            token if token.starts_with('"') => {
                let mut texts = Vec::new();
                while self.peek() != Some("]") {
                    texts.push(unquoted(&self.next()));
                }
                Value::Texts(texts)
            }
            token if token.parse::<f64>().is_ok() => Value::Numbers(self.numbers()),
            _ => Value::Nodes(self.nodes()),
        };
        self.expect("]");
        value
    }

    fn nodes(&mut self) -> Vec<Node> {
        let mut nodes = Vec::new();
        while self.peek() != Some("]") {
            if self.peek() == Some("USE") {
                self.next();
                nodes.push(Node { kind: "USE".into(), def: Some(self.next()), ..Node::default() });
            } else {
                nodes.push(self.node());
            }
        }
        nodes
    }
}

impl Node {
    /// Calls `look` for this node and all below it.
    pub fn walk<'a>(&'a self, look: &mut impl FnMut(&'a Node)) {
        look(self);
        for value in self.fields.values() {
            if let Value::Nodes(nodes) = value {
                nodes.iter().for_each(|node| node.walk(look));
            }
        }
    }

    /// The field's text. `None` if the field is missing or holds something else.
    pub fn text(&self, field: &str) -> Option<&str> {
        match self.fields.get(field) {
            Some(Value::Text(text)) => Some(text),
            _ => None,
        }
    }

    /// The field's numbers. `None` if the field is missing or holds something else.
    pub fn numbers(&self, field: &str) -> Option<&[f64]> {
        match self.fields.get(field) {
            Some(Value::Numbers(numbers)) => Some(numbers),
            _ => None,
        }
    }

    /// The nodes in a field. Empty if the field is missing or holds something else.
    pub fn nodes(&self, field: &str) -> &[Node] {
        match self.fields.get(field) {
            Some(Value::Nodes(nodes)) => nodes,
            _ => &[],
        }
    }
}
