//! The program's source as modules, and what each names: read from its text as far as tests need it.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

/// A module or a name, from the crate's root or from a module on.
pub type Names = Vec<String>;

/// What code consists of; comments and literals are left out.
#[derive(Debug, Clone, PartialEq)]
enum Token {
    Word(String),
    /// `::`
    Within,
    Sign(char),
}

/// The source below `src`, tests in its files included or not.
pub struct Source {
    modules: BTreeMap<Names, Module>,
}

/// What stands in one file.
#[derive(Default)]
struct Module {
    /// Paths by the names that `use` gives them.
    used: BTreeMap<String, Names>,
    /// All paths of two names or more, those of `use` among them.
    paths: BTreeSet<Names>,
    /// Its modules that are built for tests alone.
    tests: Vec<String>,
    /// Types that it declares outside functions and blocks of functions.
    types: BTreeSet<String>,
}

impl Source {
    /// Reads all files of the library.
    pub fn read(with_tests: bool) -> Self {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
        let mut modules = BTreeMap::new();
        read_folder(&root, &[], with_tests, &mut modules);
        let all = modules.iter();
        let tests: Vec<Names> = all
            .flat_map(|(path, module): (&Names, &Module)| {
                module.tests.iter().map(|name| child(path, name))
            })
            .collect();
        modules.retain(|path, _| !tests.iter().any(|test| path.starts_with(test)));
        Self { modules }
    }

    /// All modules, by their paths from the crate's root.
    pub fn modules(&self) -> impl Iterator<Item = &Names> {
        self.modules.keys()
    }

    /// The paths that a module names, each as it stands there.
    pub fn paths(&self, module: &[String]) -> &BTreeSet<Names> {
        &self.modules[module].paths
    }

    /// The types that a module declares; one that it declares for each system counts once.
    pub fn types(&self, module: &[String]) -> &BTreeSet<String> {
        &self.modules[module].types
    }

    /// The module in which that stands which `module` calls by `path`; none of other crates'.
    /// Names that are handed on by `use` are followed to where they come from.
    pub fn home(&self, module: &[String], path: &[String]) -> Option<Names> {
        self.follow(module, path, 0)
    }

    fn follow(&self, module: &[String], path: &[String], depth: usize) -> Option<Names> {
        // Two modules may hand all on to each other.
        if depth > 20 {
            return None;
        }
        let mut here = module.to_vec();
        let mut rest = path;
        match path.first()?.as_str() {
            "crate" => here.clear(),
            "self" => {}
            "super" => {
                while let Some(("super", more)) = rest.split_first().map(|(f, m)| (f.as_str(), m)) {
                    here.pop()?;
                    rest = more;
                }
            }
            name if self.modules.contains_key(&child(module, name)) => {
                return self.descend(here, path, depth);
            }
            name => {
                let known = self.modules[module].used.get(name)?;
                let is_itself = known.as_slice() == path;
                let known = [known, &path[1..]].concat();
                return (!is_itself && depth > 0)
                    .then(|| self.follow(module, &known, depth + 1))
                    .flatten();
            }
        }
        if matches!(path[0].as_str(), "crate" | "self") {
            rest = &path[1..];
        }
        self.descend(here, rest, depth)
    }

    /// Goes from a module down as far as there are modules.
    fn descend(&self, mut here: Names, mut rest: &[String], depth: usize) -> Option<Names> {
        while let Some((name, more)) = rest.split_first() {
            let below = child(&here, name);
            if self.modules.contains_key(&below) {
                (here, rest) = (below, more);
                continue;
            }
            let Some(known) = self.modules.get(&here).and_then(|m| m.used.get(name)) else {
                break;
            };
            return self.follow(&here, &[known, more].concat(), depth + 1);
        }
        Some(here)
    }
}

fn child(module: &[String], name: &str) -> Names {
    let mut path = module.to_vec();
    path.push(name.to_owned());
    path
}

fn read_folder(
    folder: &Path,
    module: &[String],
    with_tests: bool,
    modules: &mut BTreeMap<Names, Module>,
) {
    for entry in fs::read_dir(folder).expect("a folder of the source") {
        let path = entry.expect("an entry").path();
        let name = path.file_stem().expect("a name").to_string_lossy();
        let name = child(module, &name);
        if path.is_dir() {
            read_folder(&path, &name, with_tests, modules);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            let name = match name.last().map(String::as_str) {
                Some("main") => continue,
                Some("lib") => Vec::new(),
                _ => name,
            };
            let text = fs::read_to_string(&path).expect("a file of the source");
            modules.insert(name, Module::of(&text, with_tests));
        }
    }
}

impl Module {
    fn of(text: &str, with_tests: bool) -> Self {
        let mut module = Self::default();
        let mut tokens = tokens(text);
        if !with_tests {
            tokens = module.without_tests(&tokens);
        }
        module.types = types(&tokens);
        let mut k = 0;
        while k < tokens.len() {
            match &tokens[k] {
                Token::Word(word) if word == "use" => {
                    k = module.tree(&tokens, k + 1, &[]);
                }
                Token::Word(word) => {
                    let mut path = vec![word.clone()];
                    while let [Token::Within, Token::Word(word), ..] = &tokens[k + 1..] {
                        path.push(word.clone());
                        k += 2;
                    }
                    if path.len() > 1 {
                        module.paths.insert(path);
                    }
                }
                _ => {}
            }
            k += 1;
        }
        module
    }

    /// Takes in a tree of `use`, from a token on and below a prefix; the token that ends it.
    fn tree(&mut self, tokens: &[Token], mut k: usize, prefix: &[String]) -> usize {
        let mut path = prefix.to_vec();
        let mut name = None;
        loop {
            match &tokens[k] {
                Token::Within => {}
                Token::Word(word) if word == "as" => {
                    if let Token::Word(word) = &tokens[k + 1] {
                        name = Some(word.clone());
                    }
                    k += 1;
                }
                Token::Word(word) if word == "self" && !path.is_empty() => {}
                Token::Word(word) => path.push(word.clone()),
                Token::Sign('{') => {
                    while tokens[k] != Token::Sign('}') {
                        k = self.tree(tokens, k + 1, &path);
                    }
                    return k + 1;
                }
                Token::Sign('*') => path.push("*".to_owned()),
                Token::Sign(_) => break,
            }
            k += 1;
        }
        // A list may end with a comma.
        if path.len() > prefix.len() || tokens[k - 1] == Token::Word("self".to_owned()) {
            let name = name.unwrap_or_else(|| path.last().cloned().unwrap_or_default());
            self.used.insert(name, path.clone());
            self.paths.insert(path);
        }
        k
    }

    /// Leaves out what is built for tests alone, and takes note of such modules.
    fn without_tests(&mut self, tokens: &[Token]) -> Vec<Token> {
        let mut left = Vec::new();
        let mut k = 0;
        while k < tokens.len() {
            if !is_for_tests(&tokens[k..]) {
                left.push(tokens[k].clone());
                k += 1;
                continue;
            }
            let item = k;
            let (mut depth, mut is_over) = (0, false);
            while !is_over && k < tokens.len() {
                match tokens[k] {
                    Token::Sign('{' | '(' | '[') => depth += 1,
                    Token::Sign(')' | ']') => depth -= 1,
                    Token::Sign('}') => {
                        depth -= 1;
                        is_over = depth == 0;
                    }
                    Token::Sign(';') => is_over = depth == 0,
                    _ => {}
                }
                k += 1;
            }
            if let [.., Token::Word(module), Token::Word(name), Token::Sign(';')] = &tokens[item..k]
                && module == "mod"
            {
                self.tests.push(name.clone());
            }
        }
        left
    }
}

/// The structs, enums, traits and aliases that stand in modules; what stands in a trait, in an
/// `impl` or in a function is no name of the program's own.
fn types(tokens: &[Token]) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    // Whether the module ends with each brace that is open.
    let mut open = Vec::new();
    for (k, token) in tokens.iter().enumerate() {
        match token {
            Token::Sign('{') => open.push(k > 1 && tokens[k - 2] == Token::Word("mod".to_owned())),
            Token::Sign('}') => {
                open.pop();
            }
            Token::Word(word) if open.iter().all(|is_module| *is_module) => {
                let declares = ["struct", "enum", "trait", "type"].contains(&word.as_str());
                if let (true, Some(Token::Word(name))) = (declares, tokens.get(k + 1)) {
                    found.insert(name.clone());
                }
            }
            _ => {}
        }
    }
    found
}

/// Whether `#[cfg(test)]`, or all of that and something, begins here.
fn is_for_tests(tokens: &[Token]) -> bool {
    let word = |k: usize, is: &str| matches!(tokens.get(k), Some(Token::Word(w)) if w == is);
    let begins = tokens.starts_with(&[Token::Sign('#'), Token::Sign('[')]) && word(2, "cfg");
    begins && (word(4, "test") || word(4, "all") && word(6, "test"))
}

fn tokens(text: &str) -> Vec<Token> {
    let mut tokens = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let is_word = |c: char| c == '_' || c.is_alphanumeric();
        let length = if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if rest.starts_with("/*") {
            rest.find("*/").map_or(rest.len(), |end| end + 2)
        } else if let Some(length) = literal(rest) {
            length
        } else if is_word(first) {
            let end = rest.find(|c| !is_word(c)).unwrap_or(rest.len());
            tokens.push(Token::Word(rest[..end].to_owned()));
            end
        } else if rest.starts_with("::") {
            tokens.push(Token::Within);
            2
        } else {
            if !first.is_whitespace() {
                tokens.push(Token::Sign(first));
            }
            first.len_utf8()
        };
        rest = &rest[length..];
    }
    tokens
}

/// The length of the literal of text or of a character that begins here.
fn literal(rest: &str) -> Option<usize> {
    let prefix = rest.len() - rest.trim_start_matches(['b', 'r']).len();
    let body = &rest[prefix..];
    if rest[..prefix].contains('r') {
        let quoted = body.trim_start_matches('#');
        let hashes = body.len() - quoted.len();
        let end = format!("\"{}", "#".repeat(hashes));
        let inner = quoted.strip_prefix('"')?;
        return Some(prefix + hashes + 1 + inner.find(&end)? + end.len());
    }
    let quote = body.chars().next().filter(|c| matches!(c, '"' | '\''))?;
    let mut escaped = false;
    let mut count = 0;
    for (at, c) in body.char_indices().skip(1) {
        count += 1;
        if !escaped && c == quote {
            return Some(prefix + at + 1);
        }
        // A lifetime, or a label.
        if quote == '\'' && !escaped && count > 1 && !body[1..].starts_with('\\') {
            return None;
        }
        escaped = !escaped && c == '\\';
    }
    None
}

/// Without this the tests that stand on the reader would hold whatever the source says.
#[test]
fn all_ways_to_name_a_module_are_read() {
    let text = r##"
        //! use crate::comment::A;
        use crate::{physics, scene::{self, law::{Law as Rule, *}, Scene,}};
        pub(crate) use super::super::tui;
        /* use crate::block::B; */
        fn run<'a>(x: &'a str) -> char { let _ = r#"crate::raw::C"#; std::fs::read(x); '"' }
        fn more() { super::other::call("crate::text::D \" crate::text::E"); }
        #[cfg(test)]
        mod tests { use crate::study; fn f() { { } } }
        #[cfg(test)]
        mod far;
        fn last() -> crate::live::Live { }
    "##;
    let read = |with_tests| {
        let module = Module::of(text, with_tests);
        let paths: Vec<String> = module.paths.iter().map(|path| path.join("::")).collect();
        (paths, module)
    };
    let (paths, module) = read(false);
    let expected = [
        "crate::live::Live",
        "crate::physics",
        "crate::scene",
        "crate::scene::Scene",
        "crate::scene::law::*",
        "crate::scene::law::Law",
        "std::fs::read",
        "super::other::call",
        "super::super::tui",
    ];
    assert_eq!(paths, expected);
    assert_eq!(module.tests, ["far"]);
    assert_eq!(module.used["Rule"].join("::"), "crate::scene::law::Law");
    assert!(read(true).0.contains(&"crate::study".to_owned()));
}

#[test]
fn all_declarations_of_types_are_read() {
    let text = r#"
        /// struct Comment;
        pub(super) struct Held<'a> { text: &'a str }
        trait Mover: Send { type Place; fn go(&self) { enum Local { A } } }
        impl Mover for Held<'_> { type Place = f64; }
        type Pair = (f64, f64);
        pub type Make = fn() -> Pair;
        mod inner { pub enum Within { Struct { x: f64 } } }
        const TEXT: &str = "struct Written;";
        #[cfg(unix)] struct Tty; #[cfg(not(unix))] struct Tty;
        #[cfg(test)] mod tests { struct Tested; }
    "#;
    let expected = ["Held", "Make", "Mover", "Pair", "Tty", "Within"].map(str::to_owned);
    assert_eq!(Module::of(text, false).types, BTreeSet::from(expected));
    assert!(Module::of(text, true).types.contains("Tested"));
}
