//! The reference in `docs/reference/`: a page for each statement, function, form
//! of TEXT/ and POSTF number, and one for the words without effect, made from the
//! tables that the program itself reads.
//! `FILPOST_UPDATE=1` writes the pages anew.

use std::collections::BTreeMap;

use fil_post::no_effect;
use filpost::builtins::BUILTINS;
use filpost::cl::reader::Options;
use filpost::commons::EMPTY;
use filpost::locations::{TABLE, default_commons};
use filpost::nc::plot::{View, svg};
use filpost::plot::{self, ClText, Text};
use filpost::postf::{Grade, POSTF};
use filpost::ready::READY;
use filpost::statements::STATEMENTS;
use filpost::user_blocks;
use filpost_tests::examples::{Block, run};
use filpost_tests::posting::{Posted, Prepared};
use filpost_tests::words::Header;
use filpost_tests::{root, word_pages};

const FOLDER: &str = "docs/reference";

fn grade(grade: Grade) -> &'static str {
    match grade {
        Grade::Published => "Published in a script or listing.",
        Grade::Inferred => "Inferred from published scripts, or recalled.",
        Grade::Own => "Our own reading.",
    }
}

fn sentence(text: &str) -> String {
    let mut characters = text.chars();
    let first = characters.next().map(|first| first.to_uppercase().to_string());
    let rest = characters.as_str().trim_end_matches('.');
    format!("{}{rest}.", first.unwrap_or_default())
}

fn page(title: &str, form: &str, doc: &str, rest: &str) -> String {
    format!("# {title}\n\n```text\n{form}\n```\n\n{}\n\n{}\n", sentence(doc), rest.trim_end())
}

/// The words and items that change nothing, with the reason of each.
fn no_effect_page() -> String {
    let mut page = String::from(
        "# Words without effect\n\nFind out why a word or item of a CL record changes nothing in the NC program. Other words \
         without a handler are refused ([E0513](../errors/E0513.md)), and so are records with other \
         items that their handler does not take ([E0506](../errors/E0506.md)).\n\n| word | item | reason |\n|---|---|---|\n",
    );
    for row in no_effect::rows() {
        let item = if row.item == "*" { "the whole record" } else { row.item };
        let left_out = if row.left_out_only { " left out" } else { "" };
        page.push_str(&format!("| {} | {item}{left_out} | {} |\n", row.major, row.reason));
    }
    page
}

/// The settings that act, each with its default, what it does and a case of the suite of
/// words that sets it; then those that do not act.
fn settings_page() -> String {
    let mut page = String::from(
        "# Settings\n\nLook up every setting of a [machine](../machine.md), what it does and its values. The case is a \
         file of `tests/words` that shows its effect. `filpost explain KEY` prints the same in \
         the terminal.\n\n\
         | setting | location | default | what it does | values | case |\n|---|---|---|---|---|---|\n",
    );
    let commons = default_commons();
    let cases = cases_by_setting();
    for row in TABLE.iter().filter(|row| row.used) {
        let value = commons.get(row.kind, u32::from(row.number)).expect("a row of the table");
        let default = if value == EMPTY { "none".into() } else { value.to_string() };
        let case = cases.get(row.name).map_or("-".into(), |name| format!("`{name}`"));
        page.push_str(&format!(
            "| `{}` | {} {} | {default} | {} | {} | {case} |\n",
            row.name,
            row.kind.name(),
            row.number,
            row.meaning,
            row.choices.replace('|', ", "),
        ));
    }
    page.push_str(
        "\n## Blocks at fixed places\n\nLists of texts without a location, under `[blocks]`: \
         [blocks of your own](../machine.md#blocks-of-your-own).\n\n| list | where its blocks stand |\n|---|---|\n",
    );
    for (name, _, place) in user_blocks::OWN {
        page.push_str(&format!("| `{name}` | {place} |\n"));
    }
    page.push_str(
        "\n## Settings that do not act\n\nfilpost keeps them, and warns if you set one \
         ([W0651](../errors/W0651.md)).\n\n| setting | location | what it would do | why it does not act |\n|---|---|---|---|\n",
    );
    for row in TABLE.iter().filter(|row| !row.used) {
        let (name, kind) = (row.name, row.kind.name());
        let reason = if row.idle.is_empty() { "-" } else { row.idle };
        let (number, meaning) = (row.number, row.meaning);
        page.push_str(&format!("| `{name}` | {kind} {number} | {meaning} | {reason} |\n"));
    }
    page
}

/// The files of the suite of words, by name: header and text.
fn words() -> Vec<(String, Header, String)> {
    let folder = std::fs::read_dir(root().join("tests/words")).expect("tests/words");
    let mut files: Vec<_> = folder.map(|entry| entry.expect("an entry").path()).collect();
    files.sort();
    let read = files.into_iter().filter_map(|file| {
        let text = std::fs::read_to_string(&file).expect("a file of the suite");
        let name = file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        Header::read(&text).ok().map(|header| (name, header, text))
    });
    read.collect()
}

/// The settings that a line of a header sets: a list of blocks is three of them.
fn keys(setting: &str) -> Vec<String> {
    let key = setting.split('=').next().unwrap_or_default().trim();
    if user_blocks::LISTS.iter().any(|(list, _)| *list == key) {
        return ["flag", "count", "text"].map(|part| format!("{key}_{part}")).to_vec();
    }
    vec![key.to_string()]
}

/// The first file of the suite of words that gives something else without a setting, by
/// the setting: its case on and its case off.
fn cases_by_setting() -> BTreeMap<String, String> {
    let mut cases = BTreeMap::new();
    for (name, header, text) in words() {
        for (at, setting) in header.settings.iter().enumerate() {
            let new: Vec<String> =
                keys(setting).into_iter().filter(|key| !cases.contains_key(key)).collect();
            if new.is_empty() {
                continue;
            }
            let mut without = header.clone();
            without.settings.remove(at);
            if outcome(&header, &text) != outcome(&without, &text) {
                cases.extend(new.into_iter().map(|key| (key, name.clone())));
            }
        }
    }
    cases
}

/// Program, warnings and listing of a file, or its refusal.
fn outcome(header: &Header, text: &str) -> Result<(Posted, String), String> {
    let post = Prepared::of(header.post().map_err(|error| error.to_string())?);
    let posted = post.post(text).map_err(|refused| refused.message)?;
    let listing = post.listing(text).map_err(|refused| refused.message)?;
    Ok((posted, listing))
}

/// File name without ending, and text, of every page; the index among them.
fn pages() -> BTreeMap<String, String> {
    let mut pages = BTreeMap::new();
    let mut index = String::from(
        "# Reference\n\nLook up a statement, function, POSTF number, post word or setting. `filpost explain` \
         prints the same in the terminal.\n\n## Statements\n\n",
    );
    let mut add = |index: &mut String, file: String, title: &str, text: String| {
        index.push_str(&format!("- [{title}]({file}.md)\n"));
        assert!(pages.insert(file, text).is_none(), "two pages for {title}");
    };
    for row in STATEMENTS {
        let example = match row.example {
            "" => String::new(),
            example => format!("\n\n## Example\n\n```fil\n{example}```"),
        };
        let rest = format!("{}{example}", grade(row.grade));
        let text = page(row.word, row.form, row.doc, &rest);
        add(&mut index, format!("statement-{}", row.word), row.word, text);
    }
    index
        .push_str("\nAll other words make a record for the post: see [post words](#post-words).\n");
    index.push_str("\n## Functions and forms\n\n");
    for row in BUILTINS {
        let extension =
            if row.extension { " An extension of filpost, refused under `--strict`." } else { "" };
        let rest = format!("{}{extension}", grade(row.grade));
        let rest = format!("{rest}{}", example_of(row.name));
        let text = page(row.name, &row.call(), row.doc, &rest);
        add(&mut index, row.name.replace('/', "-"), row.name, text);
    }
    index.push_str("\n## POSTF\n\n");
    for row in POSTF {
        let arguments: Vec<String> = row.arguments.iter().map(|name| format!(",{name}")).collect();
        let call = format!("POSTF({}{})", row.number, arguments.concat());
        let operation = filpost::operation_name(row.op);
        let rest = format!("{} Its name in a compat file is `{operation}`.", grade(row.grade));
        let title = format!("POSTF({})", row.number);
        let rest = format!("{rest}{}", example_of(&title));
        let text = page(&title, &call, row.doc, &rest);
        add(&mut index, format!("POSTF-{}", row.number), &title, text);
    }
    index.push_str("\n## Post words\n\n");
    for (word, text) in word_pages::pages() {
        add(&mut index, format!("word-{word}"), &word, text);
    }
    index.push_str("\n## Machine\n\n- [Settings](settings.md)\n");
    pages.insert("settings".into(), settings_page());
    index.push_str("\n## CL records\n\n- [Words without effect](no-effect.md)\n");
    pages.insert("no-effect".into(), no_effect_page());
    pages.insert("README".into(), index);
    pages
}

#[test]
fn the_pages_say_what_the_tables_say() {
    let folder = root().join(FOLDER);
    let pages = pages();
    if std::env::var_os("FILPOST_UPDATE").is_some() {
        std::fs::create_dir_all(&folder).unwrap();
        for (name, text) in &pages {
            std::fs::write(folder.join(format!("{name}.md")), text).unwrap();
        }
    }
    for (name, text) in &pages {
        let found = std::fs::read_to_string(folder.join(format!("{name}.md"))).unwrap_or_default();
        assert_eq!(&found, text, "{FOLDER}/{name}.md");
    }
    let files = std::fs::read_dir(&folder).expect("docs/reference is there").count();
    assert_eq!(files, pages.len(), "a page without a row");
}

#[test]
fn the_summary_lists_the_reference() {
    let summary = std::fs::read_to_string(root().join("docs/SUMMARY.md")).unwrap();
    for name in pages().keys() {
        assert!(summary.contains(&format!("(reference/{name}.md)")), "{name} is not in SUMMARY.md");
    }
}

/// The pages of post words as `filpost explain` has them.
const EXPLAINED: &str = "crates/filpost/data/words.md";

#[test]
fn explain_has_the_pages_of_post_words() {
    let all: String = word_pages::pages().into_values().collect();
    let path = root().join(EXPLAINED);
    if std::env::var_os("FILPOST_UPDATE").is_some() {
        std::fs::write(&path, &all).unwrap();
    }
    assert_eq!(std::fs::read_to_string(&path).unwrap_or_default(), all, "{EXPLAINED}");
}

/// The rows of the glossary as `filpost explain` has them.
const TERMS: &str = "crates/filpost/data/terms.md";

#[test]
fn explain_has_the_terms_of_the_glossary() {
    let page = std::fs::read_to_string(root().join("docs/glossary.md")).unwrap();
    let (_, rows) = page.split_once("|---|---|---|\n").expect("the table of terms");
    let path = root().join(TERMS);
    if std::env::var_os("FILPOST_UPDATE").is_some() {
        std::fs::write(&path, rows).unwrap();
    }
    assert_eq!(std::fs::read_to_string(&path).unwrap_or_default(), rows, "{TERMS}");
}

#[test]
fn each_post_word_has_a_page() {
    let vocabulary = filpost::cl::Vocabulary::new();
    let pages = word_pages::pages();
    for (word, _) in filpost::dispatch::HANDLERS {
        let name = vocabulary.name(*word);
        assert!(pages.contains_key(name), "no example of {name} in tests/reference/words.txt");
    }
}

/// Examples of functions and POSTF numbers, by the title of their page.
const EXAMPLES: &[(&str, &str)] = &[
    (
        "POSTF(1)",
        "CIMFIL/ON,FEDRAT\nMOST=POSTF(1,3,120)\nIF(POSTF(7,4).GT.MOST)DMY=POSTF(8,4,MOST)\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n",
    ),
    ("POSTF(2)", "$$ X is written twice as large\nDMY=POSTF(2,3,486,2)\nFINI\n"),
    (
        "POSTF(3)",
        "$$ the next X is written even where it has not changed\nCIMFIL/ON,LOADTL\nDMY=POSTF(13)\nDMY=POSTF(3,3,355+X)\nCIMFIL/OFF\nFINI\n",
    ),
    ("POSTF(4)", "EMP=POSTF(4)\nFINI\n"),
    ("POSTF(5)", "CIMFIL/ON,LOADTL\nIF(POSTF(5).GT.4)OPSTOP\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n"),
    ("POSTF(6)", "CIMFIL/ON,SPINDL\nIF(POSTF(6,4).EQ.2)OPSTOP\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n"),
    (
        "POSTF(7)",
        "CIMFIL/ON,LOADTL\nTN=POSTF(7,4)\nPPRINT/'TOOL ',TN\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n",
    ),
    (
        "POSTF(8)",
        "CIMFIL/ON,FEDRAT\nDMY=POSTF(8,4,POSTF(7,4)*0.8)\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n",
    ),
    (
        "POSTF(9)",
        "CIMFIL/ON,CYCLE\nAT=POSTF(9,4,ICODEF(DEPTH))\nIF(AT.GT.0)DEEP=POSTF(7,AT+1)\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n",
    ),
    ("POSTF(10)", "CIMFIL/ON,COOLNT\nDMY=POSTF(10,5,ICODEF(HIGH))\nCIMFIL/OFF\nFINI\n"),
    (
        "POSTF(11)",
        "CIMFIL/ON,LOADTL\nIF(POSTF(5).GT.4)DMY=POSTF(11,5)\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n",
    ),
    ("POSTF(12)", "CIMFIL/ON,LOADTL\nDMY=POSTF(12,4)\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n"),
    (
        "POSTF(13)",
        "$$ a stop before each tool change, which the post then makes as usual\nCIMFIL/ON,LOADTL\nOPSTOP\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n",
    ),
    (
        "POSTF(14)",
        "$$ the record behind STOP is read with it\nCIMFIL/ON,STOP\nDMY=POSTF(13)\nATEND=POSTF(14)\nIF(ATEND.EQ.0)DMY=POSTF(13)\nCIMFIL/OFF\nFINI\n",
    ),
    (
        "POSTF(20)",
        "CIMFIL/ON,LOADTL\nDMY=POSTF(20)\nDMY=POSTF(8,4,99)\nDMY=POSTF(21)\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n",
    ),
    (
        "POSTF(21)",
        "CIMFIL/ON,LOADTL\nDMY=POSTF(20)\nDMY=POSTF(8,4,99)\nDMY=POSTF(21)\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n",
    ),
    ("POSTF(24)", "DMY=POSTF(24,1)\nFINI\n"),
    (
        "NEXTF",
        "$$ a slower feed before the path goes down\nCIMFIL/ON,FEDRAT\nIF(NEXTF(Z).LT.0)DMY=POSTF(8,4,POSTF(7,4)/2)\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n",
    ),
    ("PREVF", "CIMFIL/ON,STOP\nPPRINT/'STOPPED AT Z',PREVF(Z)\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n"),
    (
        "COUPLF",
        "CIMFIL/ON,CYCLE,DRILL\nDEEP=COUPLF(DEPTH,0)\nIF(DEEP.GT.50)OPSTOP\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n",
    ),
    ("HASF", "CIMFIL/ON,COOLNT\nIF(HASF(THRU).EQ.1)OPSTOP\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n"),
    (
        "LASTF",
        "CIMFIL/ON,LOADTL\nIF(LASTF(Z).LT.100)POSTN/OUT,G,0,Z,100\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n",
    ),
    (
        "ICODEF",
        "CIMFIL/ON,COOLNT\nIF(POSTF(7,4).EQ.ICODEF(FLOOD))OPSTOP\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n",
    ),
    (
        "POSTF(15)",
        "$$ looks at the record behind STOP, and goes back to STOP\nCIMFIL/ON,STOP\nATEND=POSTF(14)\nIF(ATEND.EQ.0)THEN\nIF(POSTF(7,2).EQ.5000)OPSTOP\nDMY=POSTF(15)\nENDIF\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n",
    ),
    (
        "POSTF(16)",
        "$$ counts the tool changes, and goes back to the first record\nCIMFIL/ON,PARTNO\nHERE=POSTF(17)\nCHANGS=0\nLN) ATEND=POSTF(14)\nIF(ATEND.EQ.0)THEN\nIF(POSTF(7,3).EQ.ICODEF(LOADTL))CHANGS=CHANGS+1\nJUMPTO/LN\nENDIF\nDMY=POSTF(16,HERE)\nDMY=POSTF(13)\nIF(CHANGS.GT.24)WARN/'MORE TOOLS THAN THE MAGAZINE HOLDS'\nCIMFIL/OFF\nFINI\n",
    ),
    (
        "POSTF(17)",
        "CIMFIL/ON,STOP\nPPRINT/'STOP OF RECORD ',POSTF(17)\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n",
    ),
    (
        "TOOLF",
        "CIMFIL/ON,LOADTL\nDMY=POSTF(13)\nNEXTTL=TOOLF(NEXT)\nIF(NEXTTL.NE.POSTF(4))PPRINT/'THEN TOOL ',NEXTTL\nCIMFIL/OFF\nFINI\n",
    ),
    (
        "PROGF",
        "CIMFIL/ON,LOADTL\nDMY=POSTF(13)\nPPRINT/'MINUTES IN ALL ',TEXTF(PROGF(TIME),0,1)\nCIMFIL/OFF\nFINI\n",
    ),
    (
        "TLISTF",
        "CIMFIL/ON,LOADTL\nDMY=POSTF(13)\nDO/LA,II=1,PROGF(TOOLS)\nPPRINT/'TOOL ',TLISTF(II,NUMBER),' CUTS ',TEXTF(TLISTF(II,CUTTIM),0,1),' MIN'\nLA) CONTIN\nCIMFIL/OFF\nFINI\n",
    ),
    (
        "OPERF",
        "CIMFIL/ON,LOADTL\nDMY=POSTF(13)\nDO/LA,II=1,PROGF(OPERS)\nNAME=TEXT/OPER,II\nPPRINT/NAME,' DOWN TO Z',TEXTF(OPERF(II,ZMIN),0,3)\nLA) CONTIN\nCIMFIL/OFF\nFINI\n",
    ),
    (
        "COMF",
        "CIMFIL/ON,FEDRAT\nIF(POSTF(7,4).GT.COMF('feed.upm_max'))OPSTOP\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n",
    ),
    (
        "OPTIONF",
        "$$ filpost: option finish-stop = { type = \"bool\", default = false, group = \"stops\", help = \"Stop before finishing\" }\nCIMFIL/ON,PPRINT\nTT=TEXT/CLW\nIF(INDXF(TT,'FINISH').GT.0.AND.OPTIONF('finish-stop').EQ.1)STOP\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n",
    ),
    ("SIZEF", "RESERV/DIA,20\nDO/LA,II=1,SIZEF(DIA)\nDIA(II)=0\nLA) CONTIN\nFINI\n"),
    (
        "INDXF",
        "$$ PPRINT STOCK 12.5 stops the machine where more than 10 mm are left\nCIMFIL/ON,PPRINT\nTT=TEXT/CLW\nAT=INDXF(TT,'STOCK ')\nIF(AT.GT.0)THEN\nVV=TEXT/PART,TT,AT+6\nIF(SCALF(VV).GT.10)STOP\nENDIF\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n",
    ),
    ("SCALF", "TT=TEXT/PART,'DEPTH 12.5',7\nDEPTHS=SCALF(TT)+1\nFINI\n"),
    (
        "TEXTF",
        "CIMFIL/ON,LOADTL\nPPRINT/'TOOL ',TEXTF(POSTF(7,4),3,ZEROS)\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n",
    ),
];

/// The part of a page with its example; nothing where there is none.
fn example_of(title: &str) -> String {
    match EXAMPLES.iter().find(|(known, _)| *known == title) {
        Some((_, example)) => format!("\n\n## Example\n\n```fil\n{example}```"),
        None => String::new(),
    }
}

#[test]
fn the_examples_run() {
    for (title, text) in EXAMPLES {
        let block = Block { words: vec!["fil"], text: (*text).into(), heading: "", line: 1 };
        let diags = run(&block).expect("an example of FIL is run");
        let errors: Vec<_> = diags.iter().filter(|diag| diag.is_error()).collect();
        assert!(errors.is_empty(), "{title}: {errors:?}");
    }
    for row in STATEMENTS.iter().filter(|row| !row.example.is_empty()) {
        let block = Block { words: vec!["fil"], text: row.example.into(), heading: "", line: 1 };
        let diags = run(&block).expect("an example of FIL is run");
        let errors: Vec<_> = diags.iter().filter(|diag| diag.is_error()).collect();
        assert!(errors.is_empty(), "{}: {errors:?}", row.word);
    }
}

/// A page with another program in its first block of NC.
fn with_program(page: &str, block: &str) -> Option<String> {
    let start = page.find("```nc\n")?;
    let end = start + page[start..].find("\n```\n")? + "\n```\n".len();
    Some(format!("{}{block}{}", &page[..start], &page[end..]))
}

/// The picture of the path of a CL file, as it must be: a part that is turned from the side.
fn picture_of(cl: &str) -> String {
    let bytes = std::fs::read(root().join(cl)).expect("a CL file");
    let text = Text { name: cl, bytes: &bytes };
    let drawing = plot::cl_file(ClText { text, options: Options::default(), unit: None });
    let drawing = drawing.expect("the path of a CL file");
    let is_turned = drawing.extent().is_some_and(|extent| extent.min[1] == extent.max[1]);
    let picture = svg(&drawing, &[if is_turned { View::Zx } else { View::Isometric }]);
    let name = cl.strip_suffix("/part.ncl").unwrap_or(cl.trim_end_matches(".ncl"));
    let path = format!("docs/paths/{}.svg", name.rsplit('/').next().unwrap_or(name));
    let file = root().join(&path);
    if std::env::var_os("FILPOST_UPDATE").is_some() {
        std::fs::create_dir_all(root().join("docs/paths")).expect("a folder");
        std::fs::write(&file, &picture).expect("the picture is written");
    }
    assert_eq!(std::fs::read_to_string(&file).unwrap_or_default(), picture, "{path}");
    path
}

#[test]
fn the_page_of_each_ready_post_shows_its_program() {
    for post in READY {
        let cases = ["production-faces", "production"].into_iter();
        let mut programs = cases.filter_map(|case| {
            let path = root().join("corpus/posts").join(post.name).join(case).join("part.nc");
            std::fs::read_to_string(path).ok()
        });
        let program = programs.next();
        let program = program
            .unwrap_or_else(|| panic!("corpus/posts/{}/production has no program", post.name));
        let block = format!("```nc\n{}\n```\n", program.trim_end());
        let file = root().join("fil-scripts/posts").join(post.name).join("README.md");
        let mut page = std::fs::read_to_string(&file).expect("the page of a ready post");
        if std::env::var_os("FILPOST_UPDATE").is_some() && !page.contains(&block) {
            page = with_program(&page, &block).expect("a page with a block `nc`");
            std::fs::write(&file, &page).expect("the page is written");
        }
        assert!(page.contains(&block), "{}", file.display());
        let said = page.lines().find_map(|line| line.strip_suffix("` as the post writes it:"));
        let cl = said.and_then(|said| said.strip_prefix('`')).expect("the CL file of the program");
        let picture = picture_of(cl);
        assert!(page.contains(&format!("](../../../{picture})\n")), "{}", file.display());
    }
}
