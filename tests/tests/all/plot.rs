//! The backplot in a real browser: it renders, tells what lies under the pointer,
//! zooms and moves.

use std::io::Cursor;

use filpost::cl::reader::Options;
use filpost::nc::plot::{CL_COLOUR, Drawing, Stroke, View, html, svg};
use filpost::plot::{self, ClText, Text};
use filpost::{Program, map};
use filpost_tests::{browser, root};
use serde_json::Value;

/// Rapid, feed, an arc, a hole that a section writes, and a tool change.
const CL: &str = "\
PARTNO / 7
UNITS / MM
LOADTL / 1
SPINDL / RPM, 900, CLW
RAPID
GOTO / 0, 0, 20
FEDRAT / 200, MMPM
GOTO / 0, 0, 0
GOTO / 60, 0, 0
CIRCLE / 60, 20, 0, 0, 0, 1, 20
GOTO / 60, 40, 0
GOTO / 0, 40, 0
DELAY / 2
RAPID
GOTO / -20, 40, 20
LOADTL / 2
RAPID
GOTO / -20, -10, 20
FINI
";

const FIL: &str = "\
CIMFIL/ON,DELAY
POSTN/OUT,(G),1,(X),30,(Y),60
CIMFIL/OFF
FINI
";

/// Cuts along a line, while the tool tilts about X.
const TILTED: &str = "\
PARTNO / 8
UNITS / MM
MULTAX / ON
LOADTL / 1
SPINDL / RPM, 900, CLW
RAPID
GOTO / 0, 0, 60, 0, 0, 1
FEDRAT / 200, MMPM
GOTO / 0, 0, 0, 0, 0, 1
GOTO / 20, 0, 0, 0, -0.08715574, 0.99619470
GOTO / 40, 10, 0, 0, -0.17364818, 0.98480775
GOTO / 60, 20, 0, 0, -0.25881905, 0.96592583
GOTO / 80, 40, 0, 0, -0.34202014, 0.93969262
GOTO / 100, 60, 0, 0, -0.42261826, 0.90630779
FINI
";

/// A CL file that says its unit itself.
fn cl_text(text: Text<'_>) -> ClText<'_> {
    ClText { text, options: Options::default(), unit: None }
}

/// The drawing of [`CL`], posted with [`FIL`], with the notes of its map.
fn drawing() -> Drawing<'static> {
    let fil = FIL.replace("(G)", "7").replace("(X)", "24").replace("(Y)", "25");
    let post = Program::builder().generic("fanuc-mill").fil("mill.fil", &fil).build().unwrap();
    let names =
        map::Names { cl: "part.ncl".into(), nc: "out.nc".into(), fil: vec!["mill.fil".into()] };
    let (mut nc, mut lines) = (Vec::new(), Vec::new());
    let run = post.start().cl_name("part.ncl");
    run.run_mapped(Cursor::new(CL), &mut nc, &names, &mut lines).unwrap();
    let text = Text { name: "out.nc", bytes: &nc };
    let mut drawing = plot::program(text, post.commons()).unwrap();
    let cl = Text { name: "part.ncl", bytes: CL.as_bytes() };
    plot::lay_under(&mut drawing, cl_text(cl), post.commons()).unwrap();
    let reader = map::MapReader::new("out.nc.map", Cursor::new(lines)).unwrap();
    plot::add_origins(&mut drawing, text, reader, &mut |name| match name {
        "part.ncl" => Some(CL.into()),
        _ => Some(fil.clone().into()),
    })
    .unwrap();
    drawing.into_owned()
}

/// A program of many motions: a spiral in small steps.
fn spiral(count: u32) -> Drawing<'static> {
    let mut nc = String::from("G21 G90 G94 G17\nG0 X0. Y0. Z5.\nG1 Z0. F500.\n");
    for step in 0..count {
        let (sine, cosine) = (f64::from(step) * 0.002).sin_cos();
        let radius = f64::from(step) * 5e-4;
        nc.push_str(&format!("G1 X{:.3} Y{:.3}\n", radius * cosine, radius * sine));
    }
    nc.push_str("M30\n");
    let post = Program::builder().generic("fanuc-mill").build().unwrap();
    let text = Text { name: "spiral.nc", bytes: nc.as_bytes() };
    plot::program(text, post.commons()).unwrap().into_owned()
}

fn said(browser: &std::path::Path, page: &str) -> Value {
    let script = include_str!("../../plot/selftest.js");
    let page = page.replace("</body>", &format!("<script>{script}</script></body>"));
    let dom = browser::dom(browser, &page, 20).unwrap();
    let start = dom.find("<pre id=\"said\">").unwrap_or_else(|| panic!("no answer: {dom:.2000}"));
    let text = &dom[start + "<pre id=\"said\">".len()..];
    let text = &text[..text.find("</pre>").unwrap()];
    let text = text.replace("&lt;", "<").replace("&gt;", ">").replace("&amp;", "&");
    serde_json::from_str(&text).unwrap()
}

#[test]
fn the_page_draws_tells_and_zooms() {
    let Some(browser) = browser::program() else { return };
    let said = said(&browser, &html(&drawing()));
    assert_eq!(said["error"], Value::Null, "{said:#}");
    for view in ["xy", "zx", "zy", "iso"] {
        let counts = &said["views"][view];
        for (at, stroke) in ["rapid", "feed"].iter().enumerate() {
            assert!(counts[at].as_u64() > Some(20), "{view} {stroke}: {said:#}");
        }
    }
    assert!(said["views"]["xy"][2].as_u64() > Some(50), "no arc: {said:#}");
    let tip = |name: &str| said["tips"][name].as_str().unwrap_or_default().to_string();
    assert!(tip("arc").contains("G3 Y40. I0. J20."), "{said:#}");
    assert!(tip("arc").contains("part.ncl:11  GOTO / 60, 40, 0"), "{said:#}");
    assert!(tip("arc").contains("arc to X60 Y40 Z0"), "{said:#}");
    assert!(tip("rapid").contains("part.ncl:"), "{said:#}");
    assert_eq!(said["nothing"], true, "{said:#}");
    let zoom = said["zoom"].as_f64().unwrap();
    assert!((0.5..0.8).contains(&zoom), "a wheel of 300 shrinks to exp(-.45): {said:#}");
    let moved = said["moved"].as_f64().unwrap();
    assert!((38.0..42.0).contains(&moved), "{said:#}");
    assert_eq!(
        (&said["without"], &said["again"]),
        (&Value::from(0), &Value::from(true)),
        "{said:#}"
    );
    assert_eq!(said["early"][2], 0, "the arc is not yet drawn: {said:#}");
    let text = |name: &str| said[name].as_str().unwrap_or_default().to_string();
    assert!(text("inForce").contains("T1 · F 200 mm/min · S 900 rpm · clockwise"), "{said:#}");
    assert!(text("clicked").contains("G3 Y40. I0. J20."), "{said:#}");
    assert_eq!((&said["row"], &said["allAgain"]), (&true.into(), &true.into()), "{said:#}");
    // A pixel may be that of a mark.
    let below = said["below"].as_array().expect("counts");
    assert!(below.iter().all(|count| count.as_u64() < Some(5)), "{said:#}");
    let operations = said["operations"].as_array().expect("a list");
    assert_eq!(operations.len(), 3, "all tools, T1, T2: {said:#}");
    assert!(said["played"].as_u64() > Some(1), "{said:#}");
    assert_eq!(said["dark"], "dark", "{said:#}");
    // What is drawn piece by piece lies in another order where lines cross.
    let whole = said["whole"].as_f64().unwrap();
    assert!((0.9..1.1).contains(&whole), "{said:#}");
    assert!(text("extent").ends_with("Z 0 to 20 mm"), "{said:#}");
    assert!(said["dropped"][0].as_str().unwrap().ends_with("motions under the path"), "{said:#}");
    let other = said["dropped"][1].as_str().unwrap();
    assert!(other.starts_with("part.nc can't be shown: it is no page"), "{said:#}");
    assert!(text("underLegend").contains("proven.html"), "{said:#}");
    assert_eq!(said["missing"], Value::Null, "{said:#}");
    let fil =
        said["rows"].as_array().expect("the program").iter().any(|row| row == "6N40 G0 X0. Y0.");
    assert!(fil, "{said:#}");
}

/// Many tools, changed at places close to each other and to the origin.
#[test]
fn no_label_of_the_page_lies_on_another_one() {
    let Some(browser) = browser::program() else { return };
    let mut nc = String::from("G21 G90 G94 G17\n");
    for tool in 1..60 {
        let (x, y) = (f64::from(tool % 8) * 0.9 - 2.0, f64::from(tool % 7) * 1.1 - 3.0);
        nc.push_str(&format!(
            "T{tool} M6\nS900 M3\nG0 X{x:.3} Y{y:.3}\nZ5.\nG1 Z{}. F200.\nG0 Z20.\n",
            -tool % 5
        ));
    }
    nc.push_str("G0 X90. Y70.\nM30\n");
    let said = said(&browser, &page_of("fanuc-mill", "out.nc", &nc));
    assert_eq!(said["error"], Value::Null, "{said:#}");
    assert_eq!(said["clashes"], serde_json::json!([]), "{said:#}");
    let labels = said["labels"].as_array().expect("labels");
    let tools =
        labels.iter().filter(|label| label.as_str().is_some_and(|text| text.starts_with('T')));
    assert!(tools.count() > 20, "{labels:?}");
}

/// A live tool square to Z on a lathe: how it lies is in the CL file.
const RADIAL: &str = "\
PARTNO / 911 RADIAL
UNITS / MM
LOADTL / 1
SPINDL / RPM, 800, CLW
FEDRAT / 0.2, MMPR
RAPID
GOTO / 22, 0, 2
GOTO / 22, 0, -60
RAPID
GOTO / 60, 0, 50
SPINDL / OFF
MODE / MILL
LOADTL / 5
SPINDL / RPM, 2000, CLW
RAPID
MULTAX / ON
GOTO / 30, 0, -20, 1, 0, 0
CYCLE / DRILL, DEPTH, 8, MMPM, 120, CLEAR, 2
GOTO / 22, 0, -20, 1, 0, 0
GOTO / 0, 22, -20, 0, 1, 0
CYCLE / OFF
RAPID
GOTO / 0, 60, -20, 0, 1, 0
SPINDL / OFF
MODE / TURN
FINI
";

#[test]
fn a_live_tool_of_a_lathe_lies_as_in_the_cl_file() {
    let post = Program::builder().generic("fanuc-mill-turn").build().unwrap();
    let mut nc = Vec::new();
    post.start().stream(Cursor::new(RADIAL), &mut nc).unwrap();
    let text = Text { name: "out.nc", bytes: &nc };
    let mut drawing = plot::program(text, post.commons()).unwrap();
    assert!(drawing.lathe && drawing.path.axes.is_empty(), "the program does not say it");
    let cl = cl_text(Text { name: "part.ncl", bytes: RADIAL.as_bytes() });
    plot::lay_under(&mut drawing, cl, post.commons()).unwrap();
    let trace = &drawing.path;
    let at = |point: [f64; 3]| {
        let near = |end: &[f64; 3]| (0..3).all(|axis| (end[axis] - point[axis]).abs() < 0.01);
        let piece =
            trace.pieces.iter().position(|piece| near(&trace.points[piece.last()])).unwrap();
        trace.axes.iter().rev().find(|(from, _)| *from <= piece).map(|(_, axis)| *axis)
    };
    assert_eq!(at([22.0, 0.0, -60.0]), Some([0.0; 3]), "a turning tool has none");
    assert_eq!(at([14.0, 0.0, -20.0]), Some([1.0, 0.0, 0.0]));
    assert_eq!(at([0.0, 14.0, -20.0]), Some([0.0, 1.0, 0.0]));
    let Some(browser) = browser::program() else { return };
    let said = said(&browser, &html(&drawing));
    assert_eq!((&said["error"], &said["opened"]), (&Value::Null, &"zx".into()), "{said:#}");
    // The lines lie on those of the path here: few of their pixels are of their colour alone.
    assert!(said["axes"].as_u64() > Some(0), "{said:#}");
    let tip = said["tips"]["feed"].as_str().unwrap_or_default();
    assert!(tip.contains("\ntool axis 0 1 0\n"), "{said:#}");
    assert!(said["legend"].as_str().unwrap().contains("tool axis"), "{said:#}");
    assert_eq!(said["clashes"], serde_json::json!([]), "{said:#}");
}

/// A program as it is drawn for a ready post.
fn page_of(ready: &str, name: &str, nc: &str) -> String {
    let post = Program::builder().generic(ready).build().unwrap();
    html(&plot::program(Text { name, bytes: nc.as_bytes() }, post.commons()).unwrap())
}

#[test]
fn a_tilting_tool_shows_its_axis() {
    let Some(browser) = browser::program() else { return };
    let post = Program::builder().generic("fanuc-5x-tables").build().unwrap();
    let mut nc = Vec::new();
    post.start().stream(Cursor::new(TILTED), &mut nc).unwrap();
    let text = Text { name: "out.nc", bytes: &nc };
    let drawing = plot::program(text, post.commons()).unwrap();
    let cl = plot::cl_file(cl_text(Text { name: "part.ncl", bytes: TILTED.as_bytes() })).unwrap();
    for drawing in [drawing, cl] {
        assert!(drawing.path.axes.len() > 3, "{:?}", drawing.path.axes);
        assert!(svg(&drawing, &View::ALL).contains(">tool axis<"));
        let said = said(&browser, &html(&drawing));
        assert_eq!(said["error"], Value::Null, "{said:#}");
        assert!(said["axes"].as_u64() > Some(20), "{said:#}");
        assert!(said["legend"].as_str().unwrap().contains("tool axis"), "{said:#}");
        assert!(said["tips"]["feed"].as_str().unwrap().contains("\ntool axis 0"), "{said:#}");
    }
}

/// Lengths are told in the unit of the program, and what counts in it too.
#[test]
fn a_program_in_inch_is_told_in_inch() {
    let Some(browser) = browser::program() else { return };
    let nc = "G20 G90 G94 G17\nM6 T1\nG0 X0. Y0. Z1.\nS900 M3\nG1 Z0. F10.\nX1.2345\nY2.\nM30\n";
    let page = page_of("fanuc-mill", "out.nc", nc);
    let said = said(&browser, &page);
    assert_eq!(said["error"], Value::Null, "{said:#}");
    assert_eq!(said["extent"], "X 0 to 1.2345 · Y 0 to 2 · Z 0 to 1 inch");
    let tip = said["tips"]["feed"].as_str().unwrap();
    assert!(tip.contains("feed to X1.2345 Y") && tip.contains("F 10 inch/min"), "{tip}");
}

/// Texts that would end a script, and letters of other languages, stand as they are.
#[test]
fn texts_of_a_program_stay_texts() {
    let Some(browser) = browser::program() else { return };
    let nc = "(</script><script>document.title=1</script> \u{424}\u{440}\u{435}\u{437}\u{430} & <!--)\n\
              G21 G90 G94 G17\nG0 X0. Y0. Z5.\nG1 Z0. F100.\nX50. (&lt; \u{2028} {{data}} \u{43e}\u{43a})\nM30\n";
    let said = said(&browser, &page_of("fanuc-mill", "</script><b>&.nc", nc));
    assert_eq!(said["error"], Value::Null, "{said:#}");
    let rows = said["rows"].as_array().unwrap();
    let first =
        "1(</script><script>document.title=1</script> \u{424}\u{440}\u{435}\u{437}\u{430} & <!--)";
    assert_eq!(rows[0], first, "{said:#}");
    assert_eq!(rows[4], "5X50. (&lt; \u{2028} {{data}} \u{43e}\u{43a})", "{said:#}");
}

/// A program with words that the machine lacks is drawn as far as it goes.
#[test]
fn gaps_of_a_path_are_listed() {
    let Some(browser) = browser::program() else { return };
    let nc = "G21 G90 G94 G17\n#1=#5001\nG0 X0. Y0. Z5.\nG1 Z0. F100.\nG65 P9\nX50.\nG0 X0. Y9. Z5.\nG1 Z1.\nM30\n";
    let said = said(&browser, &page_of("fanuc-mill", "out.nc", nc));
    assert_eq!(said["error"], Value::Null, "{said:#}");
    let missing = said["missing"].as_str().unwrap_or_default();
    assert!(missing.contains("line 2: not drawn: `#`"), "{said:#}");
    assert!(missing.contains("line 5: not drawn: the machine has no G65"), "{said:#}");
    assert!(missing.contains("line 6: not drawn: no G code"), "{said:#}");
}

#[test]
fn a_program_without_motions_opens() {
    let Some(browser) = browser::program() else { return };
    for nc in ["M30\n", "G21 G90\nG0 X5.\nM30\n", "G21 G90\nG0 X0. Y0. Z0.\nX1.\nM30\n"] {
        let said = said(&browser, &page_of("fanuc-mill", "out.nc", nc));
        assert_eq!(said["error"], Value::Null, "{nc}: {said:#}");
    }
}

/// A drawing of the program that a ready post makes of a CL file.
fn posted(ready: &str, cl: &str) -> Drawing<'static> {
    let post = Program::builder().generic(ready).build().unwrap();
    let mut nc = Vec::new();
    post.start().stream(Cursor::new(cl.to_string()), &mut nc).unwrap();
    plot::program(Text { name: "out.nc", bytes: &nc }, post.commons()).unwrap().into_owned()
}

/// The pictures of pages in docs/plot.md, as a browser shows them after a few touches;
/// `FILPOST_UPDATE=1` takes them anew. Fonts differ from machine to machine, so they are not
/// compared.
#[test]
fn the_pages_of_the_docs_are_screenshots() {
    let pages = [
        ("plot-page.png", drawing as fn() -> Drawing<'static>, include_str!("../../plot/hover.js")),
        (
            "plot-five-axes.png",
            || posted("fanuc-5x-tables", &tilting_row()),
            include_str!("../../plot/play.js"),
        ),
        ("plot-lathe.png", || posted("fanuc-lathe", SHAFT), ""),
    ];
    for (name, drawing, script) in pages {
        let (file, drawing) = (root().join("docs").join(name), drawing());
        if std::env::var_os("FILPOST_UPDATE").is_some_and(|value| value == "1")
            && let Some(browser) = browser::program()
        {
            let script = format!("<script>{script}</script></body>");
            let page = html(&drawing).replace("</body>", &script);
            browser::picture(&browser, "page.html", &page, &file).expect("a screenshot");
        }
        let picture = std::fs::read(file).unwrap_or_else(|_| panic!("docs/{name}"));
        assert!(picture.starts_with(b"\x89PNG") && picture.len() > 10_000, "{name}");
    }
}

/// Passes over a side of a dome, the tool along its normal.
fn tilting_row() -> String {
    let mut cl = String::from(
        "UNITS / MM\nMULTAX / ON\nLOADTL / 5\nSPINDL / RPM, 8000, CLW\nRAPID\nGOTO / -40, 0, 120, 0, 0, 1\nRAPID\n",
    );
    for row in 0..9 {
        for step in 0..=20 {
            let (y, x) = (f64::from(row) * 7.5 + 10.0, f64::from(step) * 4.0 - 40.0);
            let x = if row % 2 == 0 { x } else { -x };
            let z = (100.0f64 * 100.0 - x * x - y * y).sqrt();
            let point =
                [x, y, z, x / 100.0, y / 100.0, z / 100.0].map(|value| format!("{value:.6}"));
            cl.push_str(&format!("GOTO / {}\n", point.join(", ")));
            if row + step == 0 {
                cl.push_str("FEDRAT / 1200, MMPM\n");
            }
        }
    }
    cl + "RAPID\nGOTO / 40, 70, 120, 0, 0, 1\nFINI\n"
}

/// A shaft turned in three cuts and finished, with an arc at its shoulder.
const SHAFT: &str = "\
UNITS / MM
TURRET / 1
SPINDL / SMM, 180, CLW, MAXRPM, 2000
RAPID
GOTO / 31, 0, 2
FEDRAT / 0.25, MMPR
GOTO / 26, 0, 2
GOTO / 26, 0, -60
GOTO / 30, 0, -60
RAPID
GOTO / 31, 0, 2
RAPID
GOTO / 22, 0, 2
GOTO / 22, 0, -45
GOTO / 27, 0, -45
RAPID
GOTO / 31, 0, 2
TURRET / 3
RAPID
GOTO / 20, 0, 2
FEDRAT / 0.1, MMPR
GOTO / 20, 0, -40
CIRCLE / 25, 0, -40, 0, -1, 0, 5
GOTO / 25, 0, -45
GOTO / 30, 0, -60
GOTO / 33, 0, -60
FINI
";

/// A lathe's page says so, and holds what is in force.
#[test]
fn a_lathe_is_drawn_lying() {
    let post = Program::builder().generic("fanuc-lathe").build().unwrap();
    let nc = "G21 G18 G97 S500 M3\nT0101\nG0 X40. Z2.\nG99 G1 Z-20. F0.2\nX44.\nM30\n";
    let drawing =
        plot::program(Text { name: "out.nc", bytes: nc.as_bytes() }, post.commons()).unwrap();
    let Some(browser) = browser::program() else { return };
    let said = said(&browser, &html(&drawing));
    assert_eq!((&said["error"], &said["opened"]), (&Value::Null, &"zx".into()), "{said:#}");
    assert!(drawing.lathe && html(&drawing).contains("\"lathe\":true"));
    let feed = drawing.path.in_force.last().and_then(|now| now.feed);
    assert_eq!(feed, Some(fil_nc::motion::Rate::PerTurn(0.2)));
}

/// The picture of docs/plot.md; `FILPOST_UPDATE=1` draws it anew.
#[test]
fn the_picture_of_the_docs_is_drawn_by_the_code() {
    let folder = root().join("corpus/tutorial");
    let [nc, cl] = ["plate.nc", "plate.ncl"].map(|name| std::fs::read(folder.join(name)).unwrap());
    let case = filpost::case::Case::load(&folder).unwrap();
    let post = case.program().unwrap();
    let mut drawing = plot::program(Text { name: "plate.nc", bytes: &nc }, post.commons()).unwrap();
    let under = Text { name: "plate.ncl", bytes: &cl };
    plot::lay_under(&mut drawing, cl_text(under), post.commons()).unwrap();
    let picture = svg(&drawing, &View::ALL);
    let file = root().join("docs/plot.svg");
    if std::env::var_os("FILPOST_UPDATE").is_some_and(|value| value == "1") {
        std::fs::write(&file, &picture).unwrap();
    }
    assert!(std::fs::read_to_string(file).unwrap() == picture, "docs/plot.svg is an older drawing");
}

/// Grooves on a cylinder of radius 81 about Y, cut at a table that turns: on the part
/// the tool stays on the cylinder.
#[test]
fn a_turning_table_is_drawn_on_the_part() {
    let folder = root().join("corpus/papers/embos-engraving");
    let case = filpost::case::Case::load(&folder).unwrap();
    let post = case.program().unwrap();
    let nc = std::fs::read(folder.join("figure-3.nc")).unwrap();
    // The printed program has no end code, and neither has its machine.
    let drawing = plot::program(Text { name: "figure-3.nc", bytes: &nc }, post.commons()).unwrap();
    let path = &drawing.path;
    let turning = path.pieces.iter().filter(|piece| {
        let points = &path.points[piece.range()];
        piece.stroke == Stroke::Feed && points.first().map(|p| p[1]) != points.last().map(|p| p[1])
    });
    let mut count = 0;
    for piece in turning {
        for point in &path.points[piece.range()] {
            let radius = point[0].hypot(point[2]);
            assert!((radius - 81.0).abs() < 1e-6, "line {}: {point:?}", piece.line);
            count += 1;
        }
    }
    assert!(count >= 18, "{count} points");
}

#[test]
fn notes_name_the_fil_line() {
    let drawing = drawing();
    let at = drawing.notes.text.lines().position(|line| line.contains("X30. Y60."));
    let origin = drawing.notes.origin(at.expect("the block") + 1);
    assert!(origin.contains("part.ncl:13  DELAY / 2\nmill.fil:2  POSTN/OUT"), "{origin}");
}

#[test]
fn a_map_of_another_program_is_refused() {
    let post = Program::builder().generic("fanuc-mill").build().unwrap();
    let names = map::Names { cl: "part.ncl".into(), nc: "out.nc".into(), fil: vec![] };
    let (mut nc, mut lines) = (Vec::new(), Vec::new());
    post.start().run_mapped(Cursor::new(CL), &mut nc, &names, &mut lines).unwrap();
    let other = [&nc[..], b"\n"].concat();
    let text = Text { name: "out.nc", bytes: &other };
    let mut drawing = Drawing::default();
    let reader = map::MapReader::new("out.nc.map", Cursor::new(lines)).unwrap();
    let error = plot::add_origins(&mut drawing, text, reader, &mut |_| None).unwrap_err();
    assert_eq!(error.diags()[0].code.name(), "E0708");
}

#[test]
fn the_pictures_have_all_colours() {
    let Some(browser) = browser::program() else { return };
    let drawing = drawing();
    for (name, text) in [("a.html", html(&drawing)), ("a.svg", svg(&drawing, &View::ALL))] {
        let pixels = browser::screenshot(&browser, name, &text).unwrap();
        for colour in [Stroke::Rapid, Stroke::Feed, Stroke::Arc].map(Stroke::colour) {
            let found = browser::count(&pixels, colour);
            assert!(found > 60, "{name}: {found} pixels of {colour}");
        }
        // Half transparent on white.
        let under = browser::count(&pixels, "#f8d498");
        assert!(under > 200, "{name}: {under} pixels of {CL_COLOUR} under the path");
    }
}

#[test]
fn two_hundred_thousand_motions_are_readable() {
    let drawing = spiral(200_000);
    assert!(drawing.path.pieces.len() > 190_000);
    let (picture, page) = (svg(&drawing, &View::ALL), html(&drawing));
    assert!(picture.len() < 1 << 20, "SVG of {} bytes", picture.len());
    assert!(page.len() < 8 << 20, "page of {} bytes", page.len());
    let Some(browser) = browser::program() else { return };
    let said = said(&browser, &page);
    assert_eq!(said["error"], Value::Null, "{said:#}");
    assert!(said["views"]["xy"][1].as_u64() > Some(1000), "{said:#}");
    assert_eq!(said["slider"], true, "{said:#}");
    assert!(said["tips"]["feed"].as_str().is_some_and(|tip| tip.contains("feed to")), "{said:#}");
}
