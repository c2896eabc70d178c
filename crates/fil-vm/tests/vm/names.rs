//! Names resolved: definitions and uses with their places.

use fil_cl::Vocabulary;
use fil_vm::resolve::{Resolution, Role, Symbol, SymbolKind};
use fil_vm::{Analysis, FilFile, Included, LoadOptions, analyze};

/// Two macros that include one file, which reads a name that is a parameter of one.
const MAIN: &str = "\
RESERV/TAB,3
DATA/SIZES,1,2
DIA=5; RPM=ICODEF(RPM)
SHOW=MACRO/DIA,TALL=DIA
INCLUD/part.fil
TERMAC
TELL=MACRO/WIDE
INCLUD/part.fil
JUMPTO/OUT
OUT) CONTIN
TERMAC
CIMFIL/ON,CYCLE,DEEP
DO/LA,NN=1,SIZES(2)
TAB(NN)=POSTF(7,4)+SQRTF(NN)+X
LA) CONTIN
CALL/SHOW,DIA,TALL=NN
CALL/TELL,1
SPINDL/RPM*2,CLW
PPRINT dia
T1=TEXT/UP,'a'
DMY=POSTF(13)
CIMFIL/OFF
FINI
";

const PART: &str = "IF(DIA.GT.1)OPSTOP\n";

fn analysis(main: &str) -> Analysis {
    let files = [FilFile { name: "main.fil", text: main }];
    let mut loader = |_: &str, name: &str| match name {
        "part.fil" => Ok(Included { name: name.into(), text: PART.into() }),
        other => Err(format!("no {other}")),
    };
    let options = LoadOptions { loader: Some(&mut loader), ..LoadOptions::default() };
    analyze(&files, &mut Vocabulary::new(), options)
}

fn named<'r>(resolution: &'r Resolution, kind: SymbolKind, name: &str) -> &'r Symbol {
    let mut found = resolution.of_kind(kind).filter(|symbol| symbol.name == name);
    let symbol = found.next().unwrap_or_else(|| panic!("no {kind:?} {name}"));
    assert_eq!(found.next(), None, "{name} twice");
    symbol
}

/// Lines of definitions and of uses; of the second file with a minus.
fn lines(analysis: &Analysis, symbol: &Symbol) -> (Vec<i64>, Vec<(i64, Role)>) {
    let line = |location: &fil_vm::resolve::FileSpan| {
        let file = &analysis.files[location.file];
        let text = &file.text[location.span.range()];
        assert_eq!(text.to_uppercase(), symbol.name, "a span is that of the name");
        let line = i64::from(file.place(location.span).line);
        if location.file == 0 { line } else { -line }
    };
    let definitions = symbol.definitions.iter().map(line).collect();
    let uses = symbol.uses.iter().map(|used| (line(&used.location), used.role));
    (definitions, uses.collect())
}

#[test]
fn names_are_found_where_they_are_defined_and_used() {
    let analysis = analysis(MAIN);
    assert!(analysis.module.is_some(), "{:?}", analysis.diags);
    let found = |kind, name| lines(&analysis, named(&analysis.resolution, kind, name));
    use Role::{
        Argument, Asked, Call, Jump, LoopEnd, MinorKey, Operand, Parameter, Read, SetElement,
    };
    assert_eq!(found(SymbolKind::Array, "TAB"), (vec![1], vec![(14, SetElement)]));
    assert_eq!(found(SymbolKind::Table, "SIZES"), (vec![2], vec![(13, Read)]));
    let loop_variable = (vec![13], vec![(14, Read), (14, Read), (16, Argument)]);
    assert_eq!(found(SymbolKind::Variable, "NN"), loop_variable);
    // The macro TELL, which has no such parameter, reads the variable; PPRINT its value.
    let dia = (vec![3], vec![(4, Argument), (-1, Operand), (16, Argument), (19, Read)]);
    assert_eq!(found(SymbolKind::Variable, "DIA"), dia);
    assert_eq!(found(SymbolKind::Parameter, "DIA"), (vec![4], vec![(-1, Operand)]));
    assert_eq!(found(SymbolKind::Parameter, "TALL"), (vec![4], vec![(16, Parameter)]));
    assert_eq!(found(SymbolKind::Macro, "SHOW"), (vec![4], vec![(16, Call)]));
    assert_eq!(found(SymbolKind::Label, "LA"), (vec![15], vec![(13, LoopEnd)]));
    assert_eq!(found(SymbolKind::Label, "OUT"), (vec![10], vec![(9, Jump)]));
    assert_eq!(found(SymbolKind::Letter, "X"), (vec![], vec![(14, Operand)]));
    assert_eq!(found(SymbolKind::Word, "RPM"), (vec![], vec![(3, Asked)]));
    assert_eq!(found(SymbolKind::Word, "DEEP"), (vec![], vec![(12, MinorKey)]));
    assert_eq!(found(SymbolKind::Word, "OPSTOP"), (vec![], vec![(-1, Role::Major)]));
    assert_eq!(found(SymbolKind::Word, "CLW"), (vec![], vec![(18, Role::Minor)]));
    assert_eq!(found(SymbolKind::Variable, "RPM"), (vec![3], vec![(18, Operand)]));
    assert_eq!(found(SymbolKind::Function, "SQRTF"), (vec![], vec![(14, Call)]));
    assert_eq!(found(SymbolKind::Section, "CYCLE,DEEP"), (vec![12], vec![]));
}

#[test]
fn numbers_of_postf_and_forms_of_text_are_symbols() {
    let analysis = analysis(MAIN);
    let uses = |kind, name| {
        let symbol = named(&analysis.resolution, kind, name);
        let places = symbol.uses.iter().map(|used| used.location.span);
        places.map(|span| analysis.files[0].place(span).line).collect::<Vec<_>>()
    };
    assert_eq!(uses(SymbolKind::Postf, "POSTF(13)"), [21]);
    assert_eq!(uses(SymbolKind::Postf, "POSTF(7)"), [14]);
    assert_eq!(uses(SymbolKind::Function, "POSTF"), [14, 21]);
    assert_eq!(uses(SymbolKind::Function, "TEXT/UP"), [20]);
}

#[test]
fn owners_and_extents_tell_the_outline() {
    let analysis = analysis(MAIN);
    let resolution = &analysis.resolution;
    let owner = |symbol: &Symbol| {
        let owner = &resolution.symbols[symbol.owner.expect("an owner")];
        (owner.kind, owner.name.as_str())
    };
    let label = |name| named(resolution, SymbolKind::Label, name);
    assert_eq!(owner(label("LA")), (SymbolKind::Section, "CYCLE,DEEP"));
    assert_eq!(owner(label("OUT")), (SymbolKind::Macro, "TELL"));
    let wide = named(resolution, SymbolKind::Parameter, "WIDE");
    assert_eq!(owner(wide), (SymbolKind::Macro, "TELL"));
    let extent = |symbol: &Symbol| {
        let extent = symbol.extent.expect("an extent");
        analysis.files[extent.file].text[extent.span.range()].lines().count()
    };
    assert_eq!(extent(named(resolution, SymbolKind::Macro, "TELL")), 5);
    assert_eq!(extent(named(resolution, SymbolKind::Section, "CYCLE,DEEP")), 11);
}

#[test]
fn a_symbol_is_found_at_a_byte() {
    let analysis = analysis(MAIN);
    let at = |file: usize, text: &str, inner: &str| {
        let byte = analysis.files[file].text.find(text).expect("the text is there")
            + text.find(inner).expect("a part of it");
        let found = analysis.resolution.at(file, byte as u32);
        let symbols = found.map(|id| &analysis.resolution.symbols[id]);
        symbols.map(|symbol| (symbol.kind, symbol.name.as_str())).collect::<Vec<_>>()
    };
    assert_eq!(at(0, "SPINDL/RPM", "RPM"), [(SymbolKind::Variable, "RPM")]);
    assert_eq!(at(0, "SPINDL/RPM", "SPINDL"), [(SymbolKind::Word, "SPINDL")]);
    assert_eq!(at(0, "PPRINT dia", "dia"), [(SymbolKind::Variable, "DIA")]);
    let both = [(SymbolKind::Variable, "DIA"), (SymbolKind::Parameter, "DIA")];
    assert_eq!(at(1, "IF(DIA", "DIA"), both, "the two macros mean two names");
    assert_eq!(at(0, "CONTIN\nTERMAC", "CONTIN"), []);
}

#[test]
fn names_are_resolved_in_a_file_with_errors() {
    let analysis = analysis("XX=1\nYY=)\nIF(XX.EQ.1)THEN\nCALL/NOSUCH,XX\nJUMPTO/NOWHR\nFINI\n");
    assert!(analysis.module.is_none());
    let found = |kind, name| lines(&analysis, named(&analysis.resolution, kind, name));
    let uses = vec![(3, Role::Operand), (4, Role::Argument)];
    assert_eq!(found(SymbolKind::Variable, "XX"), (vec![1], uses));
    assert_eq!(found(SymbolKind::Label, "NOWHR"), (vec![], vec![(5, Role::Jump)]));
    let codes: Vec<u16> = analysis.diags.iter().map(|diag| diag.code.number).collect();
    assert_eq!(codes, [101, 207, 201], "in the order of their lines");
}

#[test]
fn what_two_includes_bring_is_reported_once() {
    let main = "MA=MACRO\nINCLUD/part.fil\nTERMAC\nMB=MACRO\nINCLUD/part.fil\nTERMAC\n\
                CALL/MA\nCALL/MB\nFINI\n";
    let files = [FilFile { name: "main.fil", text: main }];
    let mut loader = |_: &str, name: &str| {
        Ok(Included { name: name.into(), text: "IF(1.EQ.NOSUCH(2))OPSTOP\n".into() })
    };
    let options = LoadOptions { loader: Some(&mut loader), ..LoadOptions::default() };
    let analysis = analyze(&files, &mut Vocabulary::new(), options);
    let codes: Vec<u16> = analysis.diags.iter().map(|diag| diag.code.number).collect();
    assert_eq!(codes, [204]);
    let symbol = named(&analysis.resolution, SymbolKind::Unknown, "NOSUCH");
    assert_eq!(symbol.uses.len(), 1);
}

/// Each file includes the next one twice: a thousand bytes in forty files would be 2 to the
/// 40 statements.
#[test]
fn files_that_multiply_are_refused_before_they_are_read_out() {
    let files = [FilFile { name: "0", text: "INCLUD/1\nINCLUD/1\nFINI\n" }];
    let mut asked = 0;
    let mut loader = |_: &str, name: &str| {
        asked += 1;
        let next = name.parse::<u32>().map_err(|error| error.to_string())? + 1;
        let text =
            if next < 40 { format!("INCLUD/{next}\nINCLUD/{next}\n") } else { "A=1\n".into() };
        Ok(Included { name: name.into(), text })
    };
    let options = LoadOptions { loader: Some(&mut loader), ..LoadOptions::default() };
    let analysis = analyze(&files, &mut Vocabulary::new(), options);
    let refused = analysis.diags.iter().find(|diag| diag.code.number == 214).expect("refused");
    assert!(refused.message.contains("10000 files"), "{}", refused.message);
    assert!(asked < 1000, "{asked} files were read");
}
