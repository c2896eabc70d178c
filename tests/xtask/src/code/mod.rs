//! The source of our crates, read for what it holds and what uses what.

pub mod imports;
pub mod modules;
pub mod paths;

use proc_macro2::{TokenStream, TokenTree};
use syn::{Attribute, Item, Meta};

/// True for what only tests and documentation tests see.
pub fn is_for_tests(item: &Item) -> bool {
    let attributes = match item {
        Item::Fn(item) => &item.attrs,
        Item::Impl(item) => &item.attrs,
        Item::Mod(item) => &item.attrs,
        Item::Struct(item) => &item.attrs,
        Item::Use(item) => &item.attrs,
        _ => return false,
    };
    attributes.iter().any(is_test_attribute)
}

fn is_test_attribute(attribute: &Attribute) -> bool {
    let Meta::List(list) = &attribute.meta else { return attribute.path().is_ident("test") };
    let names_tests = |tree| match tree {
        TokenTree::Ident(name) => name == "test" || name == "doctest",
        _ => false,
    };
    list.path.is_ident("cfg") && list.tokens.clone().into_iter().any(names_tests)
}

/// The tokens of a stream, those in brackets too; brackets themselves are left out.
pub fn flat(stream: TokenStream, out: &mut Vec<TokenTree>) {
    for tree in stream {
        match tree {
            TokenTree::Group(group) => flat(group.stream(), out),
            tree => out.push(tree),
        }
    }
}
