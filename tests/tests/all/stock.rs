//! Right programs of every ready mill, simulated: the same material goes, and nothing is found.

use filpost::cl::reader::Options;
use filpost::nc::dialect::Dialect;
use filpost::plot::{ClText, Text};
use filpost::stock::{Job, Offsets, Simulated, Stock};
use filpost::{Levels, Program, ready, simulate};

/// A pocket with arcs, a slot on its way, a contour, deep holes, in stock of 80 x 60 x 20.
const PLATE: &str = "\
PARTNO / PLATE
UNITS / MM
LOADTL / 1
CUTTER / 10, 1
SPINDL / RPM, 3000, CLW
RAPID
GOTO / 20, 20, 50
RAPID
GOTO / 20, 20, 2
FEDRAT / 300, MMPM
GOTO / 20, 20, -4
GOTO / 60, 20, -4
CIRCLE / 60, 30, -4, 0, 0, 1, 10
GOTO / 60, 40, -4
GOTO / 20, 40, -4
CIRCLE / 20, 30, -4, 0, 0, 1, 10
GOTO / 20, 20, -4
GOTO / 40, 30, -6
RAPID
GOTO / 40, 30, 50
RAPID
GOTO / -10, 0, 50
RAPID
GOTO / -10, 0, -3
GOTO / 90, 0, -3
RAPID
GOTO / 90, 0, 50
LOADTL / 2
CUTTER / 6, 0, 3, 1.8026, 31, 0, 60
SPINDL / RPM, 1800, CLW
RAPID
GOTO / 10, 10, 50
CYCLE / DEEP, DEPTH, 18, STEP, 5, MMPM, 90, CLEAR, 2
GOTO / 10, 10, 0
GOTO / 70, 50, 0
CYCLE / OFF
RAPID
GOTO / 70, 50, 50
SPINDL / OFF
FINI
";

/// The part by a post, simulated; `None` of a machine without a tool change.
fn simulated(post: &str, stock: &str) -> Option<Simulated> {
    let program = Program::builder().ready(post).build().expect("a ready post");
    let mut nc = Vec::new();
    match program.stream(PLATE.as_bytes(), &mut nc) {
        Ok(_) => {}
        Err(error) if error.diags()[0].code.name() == "E0507" => return None,
        Err(error) => panic!("{post}: {error}"),
    }
    let text = Text { name: "plate.ncl", bytes: PLATE.as_bytes() };
    let cl = ClText { text, options: Options::default(), unit: None };
    let tools = simulate::cl_tools(&cl, program.commons()).expect("tools").tools;
    assert_eq!(tools.keys().copied().collect::<Vec<_>>(), [1, 2]);
    let stock = Stock::read(stock).expect("stock").expect("stock");
    let (levels, offsets) = (Levels::default(), Offsets::new());
    let job = Job {
        stock: &stock,
        tools: &tools,
        part: None,
        part_tolerance: 0.05,
        grid: Some(0.25),
        offsets: &offsets,
        levels: &levels,
    };
    let nc = Text { name: post, bytes: &nc };
    let text = String::from_utf8_lossy(nc.bytes);
    let done = simulate::program(nc, program.commons(), &job);
    Some(done.unwrap_or_else(|error| panic!("{error}\n{text}")))
}

#[test]
fn right_programs_of_all_mills_remove_the_same_and_nothing_is_found() {
    let mut mills = 0;
    let mut first: Option<f64> = None;
    for post in ready::READY {
        let commons = Program::builder().ready(post.name).build_machine().expect("a ready post");
        if Dialect::new(&commons).expect("a dialect").is_lathe() {
            continue;
        }
        let Some(Simulated { report, .. }) = simulated(post.name, "box 80x60x20") else { continue };
        assert!(report.findings.is_empty(), "{}: {:#?}", post.name, report.findings);
        let total = report.total();
        let first = *first.get_or_insert(total);
        assert!((total - first).abs() < first * 0.001, "{}: {total} mm3, not {first}", post.name);
        assert!(total > 8_000.0, "{}: {total}", post.name);
        mills += 1;
    }
    assert!(mills >= 10, "only {mills} mills");
}

#[test]
fn higher_stock_is_hit_at_rapid() {
    // The rapid to Z2 goes 8 mm into stock whose top is at Z10.
    let done = simulated("haas-mill", "box 80x60x30 at 0,0,-20").expect("it changes tools");
    let report = done.report;
    let first = report.findings.first().expect("a finding");
    assert_eq!((first.code.name().as_str(), first.depth.round()), ("E0971", 8.0));
}
