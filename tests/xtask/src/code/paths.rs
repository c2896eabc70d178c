//! Paths as they stand in a text: `crate::a::{b, c::d}` is two of them.

use proc_macro2::{Delimiter, TokenStream, TokenTree};
use syn::UseTree;

/// A name that a `use` brings in, and its path as written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Use {
    /// The name; `*` for all of a module.
    pub name: String,
    /// The path.
    pub path: Vec<String>,
    /// Others may import it from here.
    pub is_public: bool,
}

/// The names of a `use`.
pub fn of_use(tree: &UseTree, is_public: bool) -> Vec<Use> {
    let mut uses = Vec::new();
    below(tree, &mut Vec::new(), &mut |name, path| {
        uses.push(Use { name, path, is_public });
    });
    uses
}

fn below(tree: &UseTree, path: &mut Vec<String>, found: &mut impl FnMut(String, Vec<String>)) {
    match tree {
        UseTree::Path(part) => {
            path.push(part.ident.to_string());
            below(&part.tree, path, found);
            path.pop();
        }
        UseTree::Group(group) => group.items.iter().for_each(|tree| below(tree, path, found)),
        UseTree::Glob(_) => found("*".to_string(), path.clone()),
        UseTree::Name(name) if name.ident == "self" => {
            found(path.last().cloned().unwrap_or_default(), path.clone());
        }
        UseTree::Name(name) => {
            let name = name.ident.to_string();
            found(name.clone(), with(path, &name));
        }
        UseTree::Rename(name) if name.ident == "self" => {
            found(name.rename.to_string(), path.clone());
        }
        UseTree::Rename(name) => {
            found(name.rename.to_string(), with(path, &name.ident.to_string()));
        }
    }
}

fn with(path: &[String], name: &str) -> Vec<String> {
    let mut path = path.to_vec();
    path.push(name.to_string());
    path
}

/// All paths of at least two names in a text, those within macros too.
pub fn mentioned(stream: TokenStream) -> Vec<Vec<String>> {
    let mut found = Vec::new();
    scan(stream, &mut found);
    found
}

fn scan(stream: TokenStream, found: &mut Vec<Vec<String>>) {
    let trees: Vec<TokenTree> = stream.into_iter().collect();
    let mut at = 0;
    while at < trees.len() {
        match &trees[at] {
            TokenTree::Ident(_) => at = path_at(&trees, at, &[], found),
            TokenTree::Group(group) => {
                scan(group.stream(), found);
                at += 1;
            }
            // A path from outside the crate: `::std::fmt`.
            _ if is_colons(&trees, at) => at += 3,
            _ => at += 1,
        }
    }
}

fn is_colons(trees: &[TokenTree], at: usize) -> bool {
    let is_colon = |at: usize| match trees.get(at) {
        Some(TokenTree::Punct(sign)) => sign.as_char() == ':',
        _ => false,
    };
    is_colon(at) && is_colon(at + 1)
}

/// Reads the path that begins at a name, behind `before`; gives where the text goes on.
fn path_at(
    trees: &[TokenTree],
    at: usize,
    before: &[String],
    found: &mut Vec<Vec<String>>,
) -> usize {
    let (mut path, mut at) = (before.to_vec(), at);
    loop {
        match trees.get(at) {
            Some(TokenTree::Ident(name)) => path.push(name.to_string()),
            Some(TokenTree::Group(group)) if group.delimiter() == Delimiter::Brace => {
                for part in parts(group.stream()) {
                    path_at(&part, 0, &path, found);
                }
                return at + 1;
            }
            // `*`, or the types of a function.
            _ => break,
        }
        at += 1;
        if !is_colons(trees, at) {
            break;
        }
        at += 2;
    }
    if path.len() > 1 {
        found.push(path);
    }
    at
}

/// What stands between the commas.
fn parts(stream: TokenStream) -> Vec<Vec<TokenTree>> {
    let mut parts = vec![Vec::new()];
    for tree in stream {
        match &tree {
            TokenTree::Punct(sign) if sign.as_char() == ',' => parts.push(Vec::new()),
            _ => parts.last_mut().expect("one part").push(tree),
        }
    }
    parts.retain(|part| !part.is_empty());
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    fn paths(text: &str) -> Vec<String> {
        let found = mentioned(text.parse().unwrap());
        found.into_iter().map(|path| path.join("::")).collect()
    }

    #[test]
    fn paths_are_found_wherever_they_stand() {
        let text = "fn f(a: crate::b::C) -> super::D { m!(self::e::F { g: h::i(j) }); k.l::<m>() }";
        assert_eq!(paths(text), ["crate::b::C", "super::D", "self::e::F", "h::i"]);
        assert_eq!(
            paths("use crate::a::{self, b::{c, d}, e::*};"),
            ["crate::a::self", "crate::a::b::c", "crate::a::b::d", "crate::a::e"]
        );
        assert_eq!(paths("Vec::<crate::a::B>::new()"), ["crate::a::B"]);
        assert!(paths("a: b, if c { ::std::d() }").is_empty());
    }

    #[test]
    fn a_use_gives_its_names() {
        let item: syn::ItemUse =
            syn::parse_str("use a::{self, b as c, d::{self as e, f}, g::*};").unwrap();
        let found = of_use(&item.tree, false);
        let found: Vec<String> =
            found.iter().map(|one| format!("{}={}", one.name, one.path.join("::"))).collect();
        assert_eq!(found, ["a=a", "c=a::b", "e=a::d", "f=a::d::f", "*=a::g"]);
    }
}
