//! What a Rust file declares and names, without what only its tests do: child modules, imports and paths.
//!
//! Words and signs are read one after another, with no grammar behind them. That is enough, since a name of another
//! file comes in by `use` or by a path, in attributes also between quotes, and by nothing else. What it does not see are
//! methods: `a.b()` does not say where `b` is written.

/// A file, or a part of one: `mod name { ... }`.
#[derive(Default)]
pub(super) struct Source {
    /// `mod name;`
    pub(super) files: Vec<Declared>,
    /// `mod name { ... }`
    pub(super) parts: Vec<(String, Source)>,
    pub(super) imports: Vec<Import>,
    /// What stands as `a::b::c` or `a`, imports left out.
    pub(super) paths: Vec<Vec<String>>,
    /// What stands so between quotes in an attribute: `#[serde(with = "a::b")]`.
    pub(super) quoted: Vec<Vec<String>>,
}

/// A module in a file of its own.
pub(super) struct Declared {
    pub(super) name: String,
    /// What `#[path = "..."]` says.
    pub(super) path: Option<String>,
}

/// One name out of a `use`.
pub(super) struct Import {
    pub(super) path: Vec<String>,
    /// Under which it is known here: `*` for all of them, `_` for none.
    pub(super) name: String,
    /// `pub use`: this file need not use it itself.
    pub(super) public: bool,
}

impl Source {
    pub(super) fn of(text: &str) -> Self {
        let tokens = tokens(text);
        let mut reader = Reader { tokens: &tokens, at: 0 };
        reader.source()
    }
}

/// A word, a sign, or a text in quotes (with its first quote).
fn tokens(text: &str) -> Vec<String> {
    let mut tokens = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let length = if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if rest.starts_with("/*") {
            comment(rest)
        } else if let Some(length) = raw_text(rest) {
            tokens.push("\"".into());
            length
        } else if first == '"' {
            let length = quoted(rest, '"');
            tokens.push(rest[..length - 1].into());
            length
        } else if first == '\'' {
            // A character ends with a quote; a lifetime does not.
            let mut after = rest[1..].chars();
            let character = after.next() == Some('\\') || after.next() == Some('\'');
            if character { quoted(rest, '\'') } else { 1 + word(&rest[1..]) }
        } else if first == '_' || first.is_alphanumeric() {
            let length = word(rest);
            tokens.push(rest[..length].into());
            length
        } else if rest.starts_with("::") || rest.starts_with("..") {
            tokens.push(rest[..2].into());
            2
        } else {
            if !first.is_whitespace() {
                tokens.push(first.into());
            }
            first.len_utf8()
        };
        rest = &rest[length..];
    }
    tokens
}

fn word(text: &str) -> usize {
    text.find(|c: char| c != '_' && !c.is_alphanumeric()).unwrap_or(text.len())
}

/// Comments stand in comments.
fn comment(text: &str) -> usize {
    let (mut at, mut depth) = (2, 1);
    while depth > 0 && at < text.len() {
        let (step, change) = match &text.as_bytes()[at..] {
            [b'/', b'*', ..] => (2, 1),
            [b'*', b'/', ..] => (2, -1),
            _ => (1, 0),
        };
        (at, depth) = (at + step, depth + change);
    }
    at
}

fn quoted(text: &str, quote: char) -> usize {
    let mut escaped = false;
    for (at, c) in text.char_indices().skip(1) {
        if c == quote && !escaped {
            return at + 1;
        }
        escaped = c == '\\' && !escaped;
    }
    text.len()
}

/// How long the text is that stands here as `r"..."` or with any number of `#`.
fn raw_text(text: &str) -> Option<usize> {
    let prefix = ["br", "cr", "r"].into_iter().find(|prefix| text.starts_with(prefix))?;
    let signs = text[prefix.len()..].chars().take_while(|&c| c == '#').count();
    let begin = prefix.len() + signs;
    if !text[begin..].starts_with('"') {
        return None;
    }
    let end = format!("\"{}", "#".repeat(signs));
    let length = text[begin + 1..].find(&end).map_or(text.len(), |at| begin + 1 + at + end.len());
    Some(length)
}

struct Reader<'a> {
    tokens: &'a [String],
    at: usize,
}

impl Reader<'_> {
    fn peek(&self, ahead: usize) -> &str {
        self.tokens.get(self.at + ahead).map_or("", String::as_str)
    }

    fn next(&mut self) -> &str {
        self.at += 1;
        self.tokens.get(self.at - 1).map_or("", String::as_str)
    }

    /// Up to the end of the file, or of the braces that are open.
    fn source(&mut self) -> Source {
        let mut source = Source::default();
        let mut depth = 0_usize;
        let mut path = None;
        // Where the attribute ends that is being read.
        let mut end = 0;
        while self.at < self.tokens.len() {
            match self.peek(0) {
                "#" => match self.attribute() {
                    Attribute::Test => self.skip_item(),
                    Attribute::Path(file) => path = Some(file),
                    Attribute::Condition => {}
                    Attribute::Other { begin } => end = std::mem::replace(&mut self.at, begin),
                },
                text if self.at < end && text.starts_with('"') => {
                    source.quoted.extend(quoted_path(text));
                    self.at += 1;
                }
                "{" => {
                    depth += 1;
                    self.at += 1;
                }
                "}" => {
                    self.at += 1;
                    let Some(less) = depth.checked_sub(1) else { return source };
                    depth = less;
                }
                "mod" if is_word(self.peek(1)) && matches!(self.peek(2), ";" | "{") => {
                    let name = self.peek(1).to_string();
                    let in_file = self.peek(2) == ";";
                    self.at += 3;
                    if in_file {
                        source.files.push(Declared { name, path: path.take() });
                    } else {
                        source.parts.push((name, self.source()));
                    }
                }
                "use" if self.peek(1) != "<" => {
                    let public = self.at > 0 && matches!(self.tokens[self.at - 1].as_str(), "pub" | ")");
                    self.at += 1;
                    if self.peek(0) == "::" {
                        self.at += 1;
                    }
                    self.imports(&[], public, &mut source.imports);
                }
                // What follows a dot is a field or a method.
                "." => self.at += if is_word(self.peek(1)) { 2 } else { 1 },
                word if is_word(word) => {
                    let path = self.path();
                    source.paths.push(path);
                }
                _ => self.at += 1,
            }
        }
        source
    }

    fn path(&mut self) -> Vec<String> {
        let mut path = vec![self.next().to_string()];
        while self.peek(0) == "::" && is_word(self.peek(1)) {
            self.at += 1;
            path.push(self.next().to_string());
        }
        path
    }

    /// What of a `use` stands behind `before`.
    fn imports(&mut self, before: &[String], public: bool, imports: &mut Vec<Import>) {
        let mut path = before.to_vec();
        loop {
            match self.peek(0) {
                "{" => {
                    self.at += 1;
                    while !matches!(self.peek(0), "}" | "") {
                        self.imports(&path, public, imports);
                        if self.peek(0) == "," {
                            self.at += 1;
                        }
                    }
                    self.at += 1;
                    return;
                }
                "*" => {
                    self.at += 1;
                    imports.push(Import { path, name: "*".into(), public });
                    return;
                }
                // `{self}` is the module that stands before the braces.
                "self" if !path.is_empty() => self.at += 1,
                _ => path.push(self.next().to_string()),
            }
            if self.peek(0) == "::" {
                self.at += 1;
                continue;
            }
            let mut name = path.last().cloned().unwrap_or_default();
            if self.peek(0) == "as" {
                name = self.peek(1).to_string();
                self.at += 2;
            }
            imports.push(Import { path, name, public });
            return;
        }
    }

    /// `#[...]` or `#![...]`; a lone `#` is one of a macro's.
    fn attribute(&mut self) -> Attribute {
        self.at += 1;
        if self.peek(0) == "!" {
            self.at += 1;
        }
        if self.peek(0) != "[" {
            return Attribute::Other { begin: self.at };
        }
        let begin = self.at + 1;
        self.skip_brackets();
        let inside: Vec<&str> = self.tokens[begin..self.at - 1].iter().map(String::as_str).collect();
        match inside.as_slice() {
            ["cfg", "(", "test", ")"] | ["cfg", "(", "all", "(", "test", ..] => Attribute::Test,
            ["cfg", "(", ..] => Attribute::Condition,
            ["path", "=", file] => Attribute::Path(file.trim_start_matches('"').to_string()),
            _ => Attribute::Other { begin },
        }
    }

    /// From an opening bracket of any kind over the one that closes it.
    fn skip_brackets(&mut self) {
        let mut depth = 0_usize;
        while self.at < self.tokens.len() {
            match self.next() {
                "(" | "[" | "{" => depth += 1,
                ")" | "]" | "}" => depth -= 1,
                _ => {}
            }
            if depth == 0 {
                return;
            }
        }
    }

    /// An item, statement or field, with the attributes that it has besides.
    fn skip_item(&mut self) {
        let mut field = true;
        while self.at < self.tokens.len() {
            match self.peek(0) {
                ";" => {
                    self.at += 1;
                    return;
                }
                "," if field => {
                    self.at += 1;
                    return;
                }
                "fn" | "impl" | "struct" | "trait" | "type" => {
                    field = false;
                    self.at += 1;
                }
                "{" => {
                    self.skip_brackets();
                    // `use a::{b};` ends after its braces.
                    if self.peek(0) == ";" {
                        self.at += 1;
                    }
                    return;
                }
                "(" | "[" => self.skip_brackets(),
                // The last field of a struct.
                "}" => return,
                _ => self.at += 1,
            }
        }
    }
}

enum Attribute {
    /// `#[cfg(test)]`
    Test,
    /// Another `#[cfg(...)]`.
    Condition,
    /// `#[path = "..."]`
    Path(String),
    /// What may name others: its words are read as code, from the one at `begin` on.
    Other { begin: usize },
}

/// The path that a text in quotes is, which stands with its first quote.
fn quoted_path(text: &str) -> Option<Vec<String>> {
    let words: Vec<String> = text.strip_prefix('"')?.split("::").map(str::to_string).collect();
    words.iter().all(|name| is_word(name) && word(name) == name.len()).then_some(words)
}

fn is_word(token: &str) -> bool {
    token.starts_with(|c: char| c == '_' || c.is_alphabetic())
}
