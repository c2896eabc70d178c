//! `fil-stock` on random jobs, judged by samples of their paths, and on cuts whose volume is known.

use filpost::plot::Text;
use filpost::stock::{Job, Mesh, Offsets, Simulated, Stock, Tool, Tools};
use filpost::{Levels, Program};
use filpost_simulation::stock::{Model, Sample, Verdict};
use filpost_simulation::{jobs, seed};

const SIDES: [f64; 2] = [40.0, 30.0];
const BOTTOM: f64 = -10.0;
const CELL: f64 = 0.5;

/// What a finding may be off by: the skin of the simulation and the samples of the judge, mm.
const MARGIN: f64 = 0.08;

fn simulated(
    program: &str,
    tools: &Tools,
    stock: &Stock,
    part: Option<&Mesh>,
    grid: f64,
) -> Simulated {
    let commons =
        Program::builder().generic("fanuc-mill").build_machine().expect("the generic mill");
    let levels = Levels::default();
    let job = Job {
        stock,
        tools,
        part,
        part_tolerance: 0.05,
        grid: Some(grid),
        levels: &levels,
        offsets: &Offsets::new(),
    };
    let nc = Text { name: "job.nc", bytes: program.as_bytes() };
    filpost::simulate::program(nc, &commons, &job)
        .unwrap_or_else(|error| panic!("{error}\n{program}"))
}

/// A step: 4 mm below the top on the left, 7 mm on the right.
fn part(x: f64, _: f64) -> f64 {
    if x < 19.87 { -4.0 } else { -7.0 }
}

/// The part as STL: tops and the wall between them.
fn part_stl() -> Mesh {
    let mut text = String::from("solid step\n");
    let mut quad = |[a, b, c, d]: [[f64; 3]; 4]| {
        for corners in [[a, b, c], [a, c, d]] {
            text.push_str("facet normal 0 0 0\nouter loop\n");
            for [x, y, z] in corners {
                text.push_str(&format!("vertex {x} {y} {z}\n"));
            }
            text.push_str("endloop\nendfacet\n");
        }
    };
    for (from, to, z) in [(-1.0, 19.87, -4.0), (19.87, 41.0, -7.0)] {
        quad([[from, -1.0, z], [to, -1.0, z], [to, 31.0, z], [from, 31.0, z]]);
        quad([[from, -1.0, -10.0], [from, 31.0, -10.0], [to, 31.0, -10.0], [to, -1.0, -10.0]]);
    }
    quad([[19.87, -1.0, -7.0], [19.87, 31.0, -7.0], [19.87, 31.0, -4.0], [19.87, -1.0, -4.0]]);
    text.push_str("endsolid step\n");
    Mesh::read("step.stl", text.as_bytes()).expect("an STL file")
}

#[test]
fn random_jobs_cut_and_find_what_samples_do() {
    let stock = Stock::read("box 40x30x10").expect("a box").expect("a box");
    let mesh = part_stl();
    let mut counts = [0; 6];
    for number in 0..jobs("FILPOST_STOCK_JOBS", 24) {
        let sample = Sample::new(seed(number as u64 + 7), SIDES);
        let tools: Tools = sample
            .tools
            .iter()
            .zip(1..)
            .map(|(cutter, number)| (number, Tool::read(&cutter.description()).expect("a tool")))
            .collect();
        let done = simulated(&sample.program, &tools, &stock, Some(&mesh), CELL);
        let field = done.left.field().expect("a mill");
        let grid = *field.grid();
        let columns = (0..grid.columns).map(|column| grid.center(column, 0)[0]).collect();
        let rows = (0..grid.rows).map(|row| grid.center(0, row)[1]).collect();
        let mut model = Model::new(columns, rows, BOTTOM, part);
        for motion in &sample.motions {
            let cutter = &sample.tools[motion.tool - 1];
            let said = model.cut(motion, cutter, MARGIN);
            let is_found = |code: &str| {
                let covers = |line: u32, last: u32| line <= motion.line && motion.line <= last;
                let found = done.report.findings.iter();
                found
                    .filter(|found| found.code.name() == code)
                    .any(|found| covers(found.line, found.last))
            };
            let touch =
                if motion.rapid { Some("E0971") } else { (!motion.turning).then_some("E0973") };
            let asked =
                [(touch, said.touch), (Some("E0972"), said.holder), (Some("E0974"), said.part)];
            for (index, (code, Verdict { must, may })) in asked.into_iter().enumerate() {
                let Some(code) = code else { continue };
                let found = is_found(code);
                let complete = done.report.more == 0;
                assert!(
                    (!must || found || !complete) && (may || !found),
                    "job {number}: {code} at line {} is {found}, must {must}, may {may}\n{}\n{:#?}",
                    motion.line,
                    sample.program,
                    done.report.findings
                );
                counts[2 * index] += usize::from(must);
                counts[2 * index + 1] += usize::from(!may);
            }
        }
        for (cell, top) in field.tops().iter().enumerate() {
            let top = f64::from(*top);
            let (least, most) = (model.least[cell], model.most[cell]);
            assert!(
                least - 2e-3 <= top && top <= most + 6e-3,
                "job {number}, cell {cell}: {top} is not between {least} and {most}\n{}",
                sample.program
            );
        }
        let volume = |tops: &[f64]| tops.iter().map(|top| -top).sum::<f64>() * grid.area();
        let removed = done.report.total();
        assert!(volume(&model.most) - 5.0 <= removed && removed <= volume(&model.least) + 5.0);
    }
    println!("must and must not, by touch, holder, part: {counts:?}");
    assert!(counts.iter().all(|count| *count >= 5), "too few cases: {counts:?}");
}

/// The volume that a program removes with one tool, and the stock that is left.
fn removed(blocks: &str, tool: &str, stock: &str, grid: f64) -> f64 {
    let program = format!(
        "G21 G90 G94 G17\nT1 M6\nG0 X-20. Y15.\nG43 Z20. H1\nS900 M3\n{blocks}\nG0 Z20.\nM30\n"
    );
    let tools = Tools::from([(1, Tool::read(tool).expect("a tool"))]);
    let stock = Stock::read(stock).expect("stock").expect("stock");
    let done = simulated(&program, &tools, &stock, None, grid);
    assert!(done.report.findings.is_empty(), "{:?}", done.report.findings);
    assert!((done.report.stock - done.left.volume() - done.report.total()).abs() < 0.05);
    done.report.total()
}

/// A wall is off by half a cell at most: its length by its depth by that is the bound.
#[test]
fn simple_cuts_have_their_volume() {
    let pi = std::f64::consts::PI;
    let third = |height: f64, radius: f64| pi * radius * radius * height / 3.0;
    let point = 3.0 / (59f64).to_radians().tan();
    let ball = |radius: f64| pi * radius * radius / 2.0;
    // Blocks, tool, volume, length of walls by their depth.
    let jobs = [
        ("G0 Z-3.\nG1 X60. F200.", "D8", 40.0 * 8.0 * 3.0, 0.0),
        ("G0 Z-3.\nG1 X20. F200.", "D8", (20.0 * 8.0 + pi * 16.0 / 2.0) * 3.0, 3.0 * 53.0),
        ("G0 Z-4.\nG1 X60. F200.", "D8R4", ball(4.0) * 40.0, 0.0),
        (
            "G0 Z1.\nG0 X20.\nG1 Z-8. F90.",
            "D6A118",
            third(point, 3.0) + pi * 9.0 * (8.0 - point),
            8.0 * 6.0 * pi,
        ),
        ("G0 Z1.\nG0 X20.\nG1 Z-5. F90.", "D10", pi * 25.0 * 5.0, 5.0 * 10.0 * pi),
        // A groove on a circle of 8 mm, 2 mm wide and deep.
        (
            "G0 Z1.\nG0 X12.\nG1 Z-2. F90.\nG3 I8. J0. F200.",
            "D2",
            pi * (81.0 - 49.0) * 2.0,
            2.0 * 32.0 * pi,
        ),
        // A helix that bores a hole of 10 mm through the stock.
        (
            "G0 Z0.\nG0 X17.\nG3 Z-4. I3. J0. F90.\nG3 Z-8. I3. J0.\nG3 Z-12. I3. J0.\nG3 I3. J0.\nG1 X20.",
            "D4.001",
            pi * 25.0 * 10.0,
            10.0 * 10.0 * pi,
        ),
        (
            "G0 Z1.\nG0 X15. Y10.\nG98 G81 X15. Y10. Z-5. R1. F90.\nX25. Y20.\nG80",
            "D4",
            2.0 * pi * 4.0 * 5.0,
            2.0 * 5.0 * 4.0 * pi,
        ),
    ];
    for (blocks, tool, volume, walls) in jobs {
        for grid in [0.5, 0.1] {
            let found = removed(blocks, tool, "box 40x30x10", grid);
            // Levels are exact; a ball is a sum over cells of its height.
            let bound = walls * grid / 2.0 + volume * grid * grid / 10.0 + 0.02;
            assert!(
                (found - volume).abs() <= bound,
                "{blocks} by {tool}: {found} for {volume}, {bound} is allowed"
            );
        }
    }
}
