//! Numbers, texts, EMPTY, letters, arrays, functions.

use fil_cl::Vocabulary;
use fil_vm::{Argument, Compat, FilFile, Functions, Limits, LoadOptions, load};

use crate::bench::{Bench, globals};

#[test]
fn arithmetic_has_the_usual_precedence() {
    let bench = globals("V1=2+3*4**2;V2=-2*3;V3=(2+3)*4;V4=7/2/2;V5=2-3-4;V6=(355+7)");
    let wanted =
        [("V1", 50.0), ("V2", -6.0), ("V3", 20.0), ("V4", 1.75), ("V5", -5.0), ("V6", 362.0)];
    for (name, value) in wanted {
        assert_eq!(bench.number(name), value, "{name}");
    }
}

#[test]
fn letters_are_their_numbers_until_they_are_set() {
    let bench = globals("V1=A;V2=X;V3=Z\nA=5\nV4=A");
    let values = ["V1", "V2", "V3", "V4"].map(|name| bench.number(name));
    assert_eq!(values, [1.0, 24.0, 26.0, 5.0]);
    assert_eq!(bench.warnings.iter().map(|diag| diag.code.number).collect::<Vec<_>>(), [217]);
    assert_eq!(globals("DO/LA,I=1,2\nLA) CONTIN").warnings[0].code.number, 217);
    assert!(globals("A=1;Z=26").warnings.is_empty(), "as the default FIL file does");
}

#[test]
fn a_name_never_set_is_empty_with_one_warning_for_each_place() {
    let bench = globals("DO/LA,II=1,3\nIF(NIX.EQ.999999)RR=1\nLA) CONTIN\nVV=NIX");
    assert_eq!(bench.number("RR"), 1.0);
    assert_eq!(bench.number("VV"), 999_999.0);
    assert_eq!(bench.warned(), [309, 309]);
    assert_eq!(bench.host.warnings[0].spans[0].line, 2);
    let bench = globals("VV=999999\nIF(VV.EQ.999999)RR=1");
    assert!(bench.warned().is_empty(), "set to EMPTY on purpose");
}

#[test]
fn texts_compare_as_texts_and_never_equal_empty() {
    let bench = globals(
        "T1='AB';T2='ABC';RR=0\nIF(T1.LT.T2)RR=RR+1\nIF(T1.EQ.'AB')RR=RR+2\nIF(T1.NE.T2)RR=RR+4\nIF(T1.EQ.999999)RR=RR+8",
    );
    assert_eq!(bench.number("RR"), 7.0);
}

#[test]
fn text_joins_texts_and_numbers() {
    let bench = globals("T1='IT''S';VV=2.5\nT2=TEXT/T1,' ',VV,' MM'\nNN=LNTHF(T2)");
    assert_eq!(bench.machine.text("T2"), Some("IT'S 2.5 MM"));
    assert_eq!(bench.number("NN"), 11.0);
}

#[test]
fn a_text_never_holds_empty_or_a_negative_zero() {
    let mut bench = Bench::new("VV=999999\nT1=TEXT/'X',VV");
    assert_eq!(bench.globals().unwrap_err().code.number, 302);
    assert_eq!(globals("VV=-0.0\nT1=TEXT/'X',VV").machine.text("T1"), Some("X0"));
}

#[test]
fn long_texts_cost_fuel() {
    let limits = Limits { fuel: 1000, ..Limits::default() };
    let program = "T1=TEXT/REPEAT,'X',10000\nT2=TEXT/UP,T1\nT2=TEXT/UP,T1\nT2=TEXT/UP,T1";
    let mut bench = Bench::with(program, limits, Compat::default(), Functions::new());
    let diag = bench.globals().unwrap_err();
    assert_eq!((diag.code.number, diag.spans[0].line), (304, 4));
}

#[test]
fn texts_nobody_holds_are_given_back() {
    let limits = Limits { text_bytes: 4096, ..Limits::default() };
    let program = "DO/LA,II=1,10000\nT1=TEXT/'NUMBER ',II\nLA) CONTIN";
    let mut bench = Bench::with(program, limits, Compat::default(), Functions::new());
    bench.globals().unwrap();
    assert_eq!(bench.machine.text("T1"), Some("NUMBER 10000"));
}

#[test]
fn arrays_hold_numbers_and_texts() {
    let bench = globals(
        "RESERV/AR,10,BR,2\nDO/LA,II=1,10\nAR(II)=II*II\nLA) CONTIN\nBR(1)='ONE'\nVV=AR(AR(3)-2)\nT1=BR(1)",
    );
    assert_eq!(bench.number("VV"), 49.0);
    assert_eq!(bench.machine.text("T1"), Some("ONE"));
}

#[test]
fn functions_take_what_their_table_says() {
    let bench = globals(
        "V1=ABSF(-2);V2=SQRTF(9);V3=SINF(30);V4=ATANF(1);V5=ATAN2F(1,-1);V6=MAXF(3,9,4,1);V7=MINF(3,9,4,1)\n\
         V8=DISTF(0,0,0,2,3,6);V9=DOTF(1,2,3,4,5,6);W1=INTF(-2.7);W2=NINTF(2.5);W3=MODF(7,3);W4=SIGNF(3,-1);W5=LOG10F(1000);W6=COSF(60)",
    );
    let wanted = [
        ("V1", 2.0),
        ("V2", 3.0),
        ("V3", 0.5),
        ("V4", 45.0),
        ("V5", 135.0),
        ("V6", 9.0),
        ("V7", 1.0),
        ("V8", 7.0),
        ("V9", 32.0),
        ("W1", -2.0),
        ("W2", 3.0),
        ("W3", 1.0),
        ("W4", -3.0),
        ("W5", 3.0),
        ("W6", 0.5),
    ];
    for (name, value) in wanted {
        assert_eq!(bench.number(name), value, "{name}");
    }
}

#[test]
fn icodef_is_a_constant_and_knows_user_words() {
    let bench = globals("V1=ICODEF(MILL);V2=ICODEF(EMBOSL);V3=ICODEF(EMBOSL);V4=ICODEF(EMBOSR)");
    assert_eq!(bench.number("V1"), 151.0);
    assert_eq!(bench.number("V2"), bench.number("V3"));
    assert_ne!(bench.number("V2"), bench.number("V4"));
}

#[test]
fn the_embedding_program_adds_functions() {
    let mut functions = Functions::new();
    functions.add("weighf", 2, |args| match args {
        [Argument::Text(name), Argument::Number(factor)] => Ok(name.len() as f64 * factor),
        _ => Err("a text and a number".to_string()),
    });
    let mut bench =
        Bench::with("VV=WEIGHF('ABC',10)", Limits::default(), Compat::default(), functions);
    bench.globals().unwrap();
    assert_eq!(bench.number("VV"), 30.0);
}

/// Runs a program with functions that return a number and a text.
fn with_functions(text: &str) -> Bench {
    let mut functions = Functions::new();
    functions.add("TWICEF", 1, |args| Ok(args[0].number().ok_or("a number")? * 2.0));
    functions.add("NAMEF", 1, |args| Ok(format!("TOOL {}", args[0].number().unwrap_or(0.0))));
    let limits = Limits { text_bytes: 1000, ..Limits::default() };
    let mut bench = Bench::with(text, limits, Compat::default(), functions);
    bench.globals().unwrap_or_else(|diag| panic!("{diag}"));
    bench
}

#[test]
fn added_functions_return_numbers_and_texts() {
    let bench = with_functions("VV=TWICEF(4)\nT1=TEXT/NAMEF(VV),'!'\nNN=LNTHF(NAMEF(12))");
    assert_eq!((bench.number("VV"), bench.number("NN")), (8.0, 7.0));
    assert_eq!(bench.machine.text("T1"), Some("TOOL 8!"));
    // A loop of texts makes room for the next ones.
    with_functions("DO/LA,II=1,1000\nT1=NAMEF(II)\nLA) CONTIN");
}

#[test]
fn a_text_of_an_added_function_counts_against_the_limit() {
    let mut functions = Functions::new();
    functions.add("LONGF", 0, |_| Ok("x".repeat(2000)));
    let limits = Limits { text_bytes: 1000, ..Limits::default() };
    let mut bench = Bench::with("T1=LONGF()", limits, Compat::default(), functions);
    assert_eq!(bench.globals().unwrap_err().code.name(), "E0306");
}

/// The codes and messages of loading a program with a function of this name.
fn named(names: &[&str], text: &str) -> Vec<String> {
    let mut functions = Functions::new();
    names.iter().for_each(|name| functions.add(name, 1, |_| Ok(1.0)));
    let options = LoadOptions { functions: Some(&functions), ..LoadOptions::default() };
    let text = format!("{text}\nFINI\n");
    let files = [FilFile { name: "test.fil", text: &text }];
    match load(&files, &mut Vocabulary::new(), options) {
        Ok(_) => Vec::new(),
        Err(diags) => diags.iter().map(|diag| diag.to_string()).collect(),
    }
}

#[test]
fn an_added_function_has_a_name_of_its_own() {
    let refused = |name| {
        let said = named(&[name], "");
        assert_eq!(said.len(), 1, "{name}");
        said[0].clone()
    };
    assert_eq!(
        refused("sqrtf"),
        "E0229: a function can't be named SQRTF: FIL has a function of this name"
    );
    for name in
        ["POSTF", "IF", "ELSEIF", "MACRO", "TEXT", "X", "GOTO", "RPM", "", "9F", "A F", "ÄF"]
    {
        assert!(refused(name).starts_with("E0229: a function can't be named"), "{name}");
    }
    assert_eq!(named(&["LIFEF", "lifef"], ""), ["E0229: the function LIFEF is added twice"]);
    assert!(named(&["LIFEF", "SHOP_F2"], "VV=LIFEF(1)").is_empty());
}

#[test]
fn a_script_does_not_shadow_an_added_function() {
    assert_eq!(
        named(&["LIFEF"], "RESERV/LIFEF,3\nVV=LIFEF(1)"),
        ["E0209 test.fil:1:8: LIFEF is a function of the embedding program"]
    );
    let written = named(&["LIFEF"], "PPRINT LIFEF(3)");
    assert!(written[0].starts_with("E0213 "), "{written:?}");
}

#[test]
fn a_loop_is_cancelled_while_it_runs() {
    for fil in
        ["LA) XX=1\nJUMPTO/LA", "DO/LA,II=1,99999999\nLA) CONTIN", "LA) TT=LOWT()\nJUMPTO/LA"]
    {
        let mut functions = Functions::new();
        functions.add("LOWT", 0, |_| Ok("a"));
        let mut bench = Bench::with(fil, Limits::default(), Compat::default(), functions);
        bench.host.patience = Some(3);
        let diag = bench.globals().unwrap_err();
        assert_eq!((diag.message.as_str(), bench.host.patience), ("cancelled", Some(0)), "{fil}");
    }
}

#[test]
fn all_fuel_is_used_before_a_run_is_given_up() {
    for fuel in [1000, 65_536, 65_537, 200_000] {
        let limits = Limits { fuel, ..Limits::default() };
        let loops = |passes| {
            let text = format!("DO/LA,II=1,{passes}\nLA) CONTIN");
            Bench::with(&text, limits, Compat::default(), Functions::new()).globals()
        };
        assert!(loops(fuel).is_ok(), "{fuel}");
        assert_eq!(loops(fuel + 1).unwrap_err().code.name(), "E0304", "{fuel}");
    }
}

#[test]
fn a_machine_moves_between_threads() {
    let mut bench = Bench::new("VV=1");
    let machine = std::thread::spawn(move || {
        bench.globals().unwrap();
        bench.machine
    });
    assert_eq!(machine.join().unwrap().number("VV"), Some(1.0));
}
