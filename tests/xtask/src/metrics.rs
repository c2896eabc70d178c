//! The shape of our two big crates in numbers: how large structs are, what imports each other
//! in a circle, how often the same question is asked.

use std::collections::BTreeMap;
use std::process::ExitCode;

use proc_macro2::TokenTree;
use quote::ToTokens;
use syn::{Fields, Item};

use crate::code::flat;
use crate::code::imports::Imports;
use crate::code::modules::{Crate, Module};

/// The post, with what was split off from it.
const POST: [&str; 2] = ["fil-post", "fil-control"];

/// The judge.
const JUDGE: &str = "fil-nc";

/// A struct of more fields counts as large.
const LARGE: usize = 12;

/// Structs that are shown.
const SHOWN: usize = 8;

/// Tells the shape of the code: sizes of structs, circles of imports, refusals, checks of the
/// control family, lines.
#[derive(clap::Args)]
pub struct Args {
    /// End with 1 where a number is above its aim
    #[arg(long)]
    check: bool,
    /// Print what uses what right below the root of a crate, as in tests/xtask/architecture/
    #[arg(long, value_name = "CRATE")]
    arrows: Option<String>,
}

/// A struct with named fields.
#[derive(Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Struct {
    fields: usize,
    name: String,
    file: String,
}

/// A number and what it shall be at most.
struct Measure {
    what: String,
    is: usize,
    aim: Option<usize>,
}

/// Runs `cargo xtask metrics`.
///
/// # Errors
/// A file that can't be read.
pub fn command(args: &Args) -> Result<ExitCode, String> {
    let crates = filpost_tests::root().join("crates");
    let read = |name: &str| Crate::read(&crates.join(name).join("src"));
    if let Some(name) = &args.arrows {
        print!("{}", arrows(&read(name)?));
        return Ok(ExitCode::SUCCESS);
    }
    let there = POST.iter().filter(|name| crates.join(name).is_dir());
    let post: Vec<Crate> = there.map(|name| read(name)).collect::<Result<_, _>>()?;
    let judge = read(JUDGE)?;
    let mut measures = of_structs(&post, &judge);
    measures.extend(of_circles(&post[0], &judge));
    measures.extend(of_texts(&post));
    for Measure { what, is, aim } in &measures {
        match aim {
            Some(aim) => println!("{is:>6} of at most {aim:>5}: {what}"),
            None => println!("{is:>6}                : {what}"),
        }
    }
    let missed = measures.iter().any(|one| one.aim.is_some_and(|aim| one.is > aim));
    Ok(if args.check && missed { ExitCode::FAILURE } else { ExitCode::SUCCESS })
}

/// For each folder and file right below the root those that it uses.
fn arrows(source: &Crate) -> String {
    let imports = Imports::of(source);
    let mut lines: BTreeMap<&str, String> = BTreeMap::new();
    for (from, to) in imports.between_tops().into_keys() {
        let line = lines.entry(from).or_insert_with(|| format!("{from}:"));
        line.push(' ');
        line.push_str(to);
    }
    lines.into_values().map(|line| line + "\n").collect()
}

fn of_structs(post: &[Crate], judge: &Crate) -> Vec<Measure> {
    let of_judge = structs(judge);
    let mut structs: Vec<Struct> = post.iter().flat_map(structs).chain(of_judge).collect();
    structs.retain(|one| one.fields > LARGE);
    structs.sort_by(|a, b| b.cmp(a));
    let all = structs.iter().map(|one| one.fields).sum();
    let what = format!("fields in structs of more than {LARGE}, post and judge");
    // What a machine is, the judge reads once.
    structs.retain(|one| !one.file.starts_with("dialect"));
    let shown = structs.into_iter().take(SHOWN).map(|one| Measure {
        what: format!("fields of {} ({})", one.name, one.file),
        is: one.fields,
        aim: Some(25),
    });
    shown.chain([Measure { what, is: all, aim: Some(300) }]).collect()
}

fn structs(source: &Crate) -> Vec<Struct> {
    let of_module = |module: &Module| -> Vec<Struct> {
        let file = module.file.display().to_string();
        let named = module.items.iter().filter_map(|item| match item {
            Item::Struct(item) => match &item.fields {
                Fields::Named(fields) => Some((item.ident.to_string(), fields.named.len())),
                _ => None,
            },
            _ => None,
        });
        named.map(|(name, fields)| Struct { fields, name, file: file.clone() }).collect()
    };
    source.modules.values().flat_map(of_module).collect()
}

fn of_circles(post: &Crate, judge: &Crate) -> Vec<Measure> {
    let circle = |name: &str, imports: &Imports, of: &str, aim| {
        let (is, all) = (imports.circle().len(), imports.arrows.len());
        Measure { what: format!("files of {name} in one circle of {of}, of {all}"), is, aim }
    };
    let (lines, paths) = ("`use` lines", "paths, a folder's `mod.rs` and its files too");
    vec![
        circle(POST[0], &Imports::by_use(post), lines, Some(3)),
        circle(JUDGE, &Imports::by_use(judge), lines, None),
        circle(POST[0], &Imports::of(post), paths, None),
        circle(JUDGE, &Imports::of(judge), paths, None),
    ]
}

fn of_texts(post: &[Crate]) -> Vec<Measure> {
    let sum = |count: fn(&Module) -> usize| -> usize {
        post.iter().flat_map(|source| source.modules.values()).map(count).sum()
    };
    let measure = |what: &str, is, aim| Measure { what: what.into(), is, aim: Some(aim) };
    let lines = post.iter().map(|source| source.lines).sum();
    vec![
        measure("lines of the post", lines, 26_000),
        measure("functions `refuse_…` of the post", sum(refusals), 45),
        measure("checks of the control family outside of its folders", sum(family_checks), 20),
    ]
}

/// The tokens of a module's items.
fn tokens(module: &Module) -> Vec<TokenTree> {
    let mut trees = Vec::new();
    module.items.iter().for_each(|item| flat(item.to_token_stream(), &mut trees));
    trees
}

fn is_word(tree: &TokenTree, is: impl Fn(&str) -> bool) -> bool {
    matches!(tree, TokenTree::Ident(name) if is(&name.to_string()))
}

fn refusals(module: &Module) -> usize {
    let is_refusal = |pair: &&[TokenTree]| {
        is_word(&pair[0], |word| word == "fn")
            && is_word(&pair[1], |word| word.starts_with("refuse_"))
    };
    tokens(module).windows(2).filter(is_refusal).count()
}

/// Folders and the file that the families of controls have for themselves.
const FAMILIES: [&str; 4] =
    ["control/klartext/", "control/sinumerik/", "control/word_address/", "/family.rs"];

/// Words that ask for the family of a control.
const QUESTIONS: [&str; 3] = ["is_klartext", "is_sinumerik", "is_word_address"];

fn family_checks(module: &Module) -> usize {
    let file = format!("/{}", module.file.display()).replace('\\', "/");
    if FAMILIES.iter().any(|place| file.contains(place)) {
        return 0;
    }
    let trees = tokens(module);
    let is_path =
        |at: usize| matches!(trees.get(at), Some(TokenTree::Punct(sign)) if sign.as_char() == ':');
    let asks = |(at, tree): &(usize, &TokenTree)| {
        is_word(tree, |word| QUESTIONS.contains(&word))
            || is_word(tree, |word| word == "ControlFamily") && is_path(at + 1) && is_path(at + 2)
    };
    trees.iter().enumerate().filter(asks).count()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn module(file: &str, text: &str) -> Crate {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(file);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
        let name = file.trim_end_matches(".rs").replace('/', "; pub mod ");
        let ends = "}".repeat(file.matches('/').count());
        let name = name.replace(';', " {");
        std::fs::write(folder.path().join("lib.rs"), format!("mod {name};{ends}")).unwrap();
        Crate::read(folder.path()).unwrap()
    }

    const TEXT: &str = "struct A { a: u8, b: u8 }\nstruct B(u8);\n\
                        impl A { fn refuse_this(&self) { if self.is_klartext() {} } }\n\
                        fn refuse_that() { m!(ControlFamily::Klartext); family::is_sinumerik() }\n\
                        fn f(family: ControlFamily) {}\n\
                        #[cfg(test)] mod tests { fn refuse_in_a_test() {} struct C { c: u8 } }\n";

    #[test]
    fn structs_refusals_and_checks_are_counted() {
        let source = module("path.rs", TEXT);
        let found = structs(&source);
        assert_eq!(found, [Struct { fields: 2, name: "A".into(), file: "path.rs".into() }]);
        let path = &source.modules[&vec!["path".to_string()]];
        assert_eq!((refusals(path), family_checks(path)), (2, 3));
        assert_eq!(source.lines, 7);
    }

    #[test]
    fn the_folders_of_the_families_may_ask() {
        let source = module("control/klartext.rs", "fn f() { is_klartext() }");
        let asked: usize = source.modules.values().map(family_checks).sum();
        assert_eq!(asked, 1);
        let source = module("control/klartext/a.rs", "fn f() { is_klartext() }");
        assert_eq!(source.modules.values().map(family_checks).sum::<usize>(), 0);
    }
}
