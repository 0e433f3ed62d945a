//! Doc comments: long sentences, words for persons, and vague measures.

/// A line number in a file, and text found there.
pub struct Place {
    /// Line, from 1.
    pub line: usize,
    /// The line of the doc comment, or the sentence that begins on it.
    pub text: String,
}

/// Words for persons, which should not stand for robots and values.
const PERSONS: [&str; 6] = ["who", "whom", "whoever", "nobody", "everybody", "somebody"];
/// Words that make a vague measure after "so", where the doc should name a symbol.
const MEASURES: [&str; 7] = ["many", "much", "far", "often", "long", "near", "badly"];

/// Doc lines that contain a word for a person.
pub fn persons(text: &str) -> Vec<Place> {
    lines_where(text, |words| words.iter().any(|word| PERSONS.contains(&word.as_str())))
}

/// Doc lines with "so" before a word of `MEASURES`.
pub fn vague(text: &str) -> Vec<Place> {
    lines_where(text, |words| {
        words.windows(2).any(|pair| pair[0] == "so" && MEASURES.contains(&pair[1].as_str()))
    })
}

fn lines_where(text: &str, holds: impl Fn(&[String]) -> bool) -> Vec<Place> {
    let lines = text.lines().enumerate().filter_map(|(number, line)| Some((number + 1, doc_text(line)?)));
    let found = lines.filter(|(_, line)| {
        let words: Vec<String> = line
            .split(|letter: char| !letter.is_alphabetic())
            .filter(|word| !word.is_empty())
            .map(str::to_lowercase)
            .collect();
        holds(&words)
    });
    found.map(|(line, text)| Place { line, text: text.trim().to_owned() }).collect()
}

/// The text of a doc comment's line without its slashes. `None` for other lines.
fn doc_text(line: &str) -> Option<&str> {
    let line = line.trim_start();
    let text = line.strip_prefix("///").or_else(|| line.strip_prefix("//!"))?;
    (!text.starts_with('/')).then_some(text)
}

/// Sentences of doc comments with more words than `most`.
pub fn long_sentences(text: &str, most: usize) -> Vec<Place> {
    let mut sentences = Sentences::default();
    for (number, line) in text.lines().enumerate() {
        match doc_text(line) {
            Some(text) => sentences.add(number + 1, text),
            None => sentences.close_block(),
        }
    }
    sentences.close_block();
    let long = sentences.done.into_iter().filter(|place| word_count(&place.text) > most);
    long.collect()
}

fn word_count(sentence: &str) -> usize {
    sentence.split_whitespace().filter(|word| word.contains(char::is_alphanumeric)).count()
}

#[derive(Default)]
struct Sentences {
    done: Vec<Place>,
    /// The sentence that has not ended yet.
    open: Option<Place>,
    in_code: bool,
}

impl Sentences {
    fn add(&mut self, line: usize, text: &str) {
        let text = text.trim();
        if text.starts_with("```") {
            self.in_code = !self.in_code;
            self.close();
        } else if !self.in_code {
            if text.is_empty() || ["- ", "* ", "#", "|"].iter().any(|mark| text.starts_with(mark)) {
                self.close();
            }
            if !text.starts_with('|') {
                text.split_whitespace().for_each(|word| self.add_word(line, word));
            }
        }
    }

    fn add_word(&mut self, line: usize, word: &str) {
        let open = self.open.get_or_insert_with(|| Place { line, text: String::new() });
        open.text.push_str(if open.text.is_empty() { "" } else { " " });
        open.text.push_str(word);
        let bare = word.trim_end_matches([')', '"', '*', '`', '”']);
        if bare.ends_with(['.', '!', '?']) && !["e.g.", "i.e.", "eq.", "al.", "vs."].contains(&bare) {
            self.close();
        }
    }

    fn close(&mut self) {
        self.done.extend(self.open.take());
    }

    fn close_block(&mut self) {
        self.close();
        self.in_code = false;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn persons_and_vague_measures_are_found_in_docs_alone() {
        let text =
            "/// Whoever stops.\n// who\nlet who = 1;\n//! So  far from it, so that it holds.\n//// who\n";
        assert_eq!(persons(text).iter().map(|place| place.line).collect::<Vec<_>>(), [1]);
        assert_eq!(vague(text).iter().map(|place| place.line).collect::<Vec<_>>(), [4]);
    }

    #[test]
    fn a_sentence_runs_over_lines_and_ends_with_its_doc() {
        let text = "/// One two\n/// three. Four\nfn a() {}\n/// five.\n/// - six\n/// - seven\n/// ```\n/// a b c d e\n/// ```\n";
        let found: Vec<_> =
            long_sentences(text, 0).into_iter().map(|place| (place.line, place.text)).collect();
        let expected = [(1, "One two three."), (2, "Four"), (4, "five."), (5, "- six"), (6, "- seven")]
            .map(|(line, text)| (line, text.to_owned()));
        assert_eq!(found, expected);
    }

    #[test]
    fn only_sentences_above_the_limit_are_long() {
        assert!(long_sentences("/// a b — c.\n", 3).is_empty());
        assert_eq!(long_sentences("/// a b c d.\n", 3).len(), 1);
    }
}
