//! Chains of axes: those that come with the post are machines, their drawings are those of
//! the book, and what the post solves for random poses on random chains is what the
//! forward kinematics of the back-check say.
//!
//! `FILPOST_POSES=1000000 cargo test -p filpost-tests --test all chains::` tries a million.

use fil_machine::axis_chain::{AxisChain, Carries, Rotary};
use fil_machine::{chain_drawing, chains};
use fil_nc::forward::Forward;
use fil_nc::motion::Position;
use filpost::Program;
use filpost_tests::root;
use filpost_tests::rs274::{self, Canon};
use nalgebra::{Point3, Unit, Vector3};

/// Poses of the normal run.
const POSES: u64 = 20_000;

/// A lean that the post takes for none, radians.
const UPRIGHT: f64 = 2e-5;

fn machine(name: &str) -> Program {
    let chain = format!("chain=\"{name}\"");
    Program::builder().generic("fanuc-mill").set(&chain).build().expect("a machine")
}

#[test]
fn the_book_has_the_drawing_of_each_chain() {
    let page = std::fs::read_to_string(root().join("docs/machines.md")).expect("the page");
    for chain in chains::CHAINS {
        let post = machine(chain.name);
        let svg = chain_drawing::svg(post.commons()).expect("a picture");
        let path = root().join(format!("docs/chains/{}.svg", chain.name));
        if std::env::var_os("FILPOST_UPDATE").is_some() {
            std::fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
            std::fs::write(&path, &svg).expect("written");
        }
        assert_eq!(std::fs::read_to_string(&path).unwrap_or_default(), svg, "{}", chain.name);
        assert!(page.contains(&format!("chains/{}.svg", chain.name)), "{}", chain.name);
        assert!(page.contains(chain.title), "{}", chain.title);
    }
}

#[test]
fn a_chain_is_drawn_from_the_part_to_the_tool() {
    let text = chain_drawing::text(machine("table-c-head-b").commons()).expect("a drawing");
    let names: Vec<&str> = text.lines().filter(|line| !line.contains("   ab")).collect();
    let order = ["part", "table C (primary)", "X, Y, Z", "head B (secondary)", "tool"];
    let mut from = 0;
    for link in order {
        let at =
            names[from..].iter().position(|line| line.trim_start_matches("└─ ").contains(link));
        from += at.unwrap_or_else(|| panic!("{link} in\n{text}")) + 1;
    }
    assert!(text.contains("about Y through 0, 0, 0"), "{text}");
    assert!(text.contains("-30 to 110 degrees"), "{text}");
    assert!(text.contains("its tip 150 mm from the pivot"), "{text}");
}

#[test]
fn a_chain_that_is_not_there_is_refused() {
    let built = Program::builder().generic("fanuc-mill").set("chain=\"tables-xy\"").build();
    let error = built.expect_err("refused").to_string();
    assert!(error.contains("E0605") && error.contains("tables-xy"), "{error}");
}

/// LinuxCNC's interpreter takes all programs of its five-axis post, and moves where they say.
#[test]
fn linuxcnc_reads_the_programs_for_it() {
    let Some(interpreter) = rs274::installed() else {
        println!("no rs274: skipped");
        return;
    };
    let cases = filpost::case::find(&root().join("corpus/posts/linuxcnc-5x")).expect("cases");
    assert_eq!(cases.len(), 12);
    for case in cases {
        let nc = std::fs::read_to_string(case.folder.join("part.nc")).expect("a program");
        let calls = rs274::run(&interpreter, &nc)
            .unwrap_or_else(|said| panic!("{}: {said}", case.folder.display()));
        let turned = calls.iter().any(|call| match &call.canon {
            Canon::Traverse(to) | Canon::Feed(to) => to[3] != 0.0 && to[5] != 0.0,
            _ => false,
        });
        let plain = ["plain", "arcs", "production"].iter().any(|name| case.folder.ends_with(name));
        assert!(turned || plain, "{}", case.folder.display());
    }
}

/// A small generator of numbers, the same in each run.
struct Dice(u64);

impl Dice {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    fn within(&mut self, most: f64) -> f64 {
        (self.next() * 2.0 - 1.0) * most
    }

    fn vector(&mut self, most: f64) -> Vector3<f64> {
        Vector3::new(self.within(most), self.within(most), self.within(most))
    }

    fn chance(&mut self, share: f64) -> bool {
        self.next() < share
    }

    fn direction(&mut self) -> Unit<Vector3<f64>> {
        let named = [Vector3::x(), Vector3::y(), Vector3::z(), Vector3::new(0.0, 1.0, 1.0)];
        let way = if self.chance(0.7) {
            named[(self.next() * 4.0) as usize]
        } else {
            self.vector(1.0) + Vector3::new(0.0, 0.0, 1e-3)
        };
        let sign = if self.chance(0.5) { 1.0 } else { -1.0 };
        Unit::new_normalize(way * sign)
    }

    fn rotary(&mut self, carries: Carries) -> Rotary {
        let limits = self.chance(0.3).then(|| (-200.0 * self.next(), 200.0 * self.next()));
        Rotary {
            carries,
            direction: self.direction(),
            center: Point3::from(self.vector(200.0)),
            letter: fil_machine::Letter::of(b'A'),
            axis: 0,
            min: limits.map(|(min, _)| min),
            max: limits.map(|(_, max)| max),
            zones: Default::default(),
        }
    }

    fn chain(&mut self) -> AxisChain {
        let carries = match (self.next() * 3.0) as u32 {
            0 => [Carries::Table, Carries::Table],
            1 => [Carries::Table, Carries::Head],
            _ => [Carries::Head, Carries::Head],
        };
        let mut rotaries = carries.map(|carries| Some(self.rotary(carries)));
        if self.chance(0.2) {
            rotaries[usize::from(self.chance(0.5))] = None;
        }
        let tool = if self.chance(0.7) { Vector3::z_axis() } else { self.direction() };
        let pivot = self.chance(0.5).then(|| 50.0 + 300.0 * self.next());
        AxisChain { rotaries, tool, pivot }
    }
}

/// Two axes of one direction turn the tool about one line only.
fn is_a_machine(chain: &AxisChain) -> bool {
    match &chain.rotaries {
        [Some(one), Some(two)] => one.direction.cross(&two.direction).norm() > 0.05,
        _ => true,
    }
}

/// What has no lean has no direction to turn to: the post leaves that axis where it is.
fn is_off_the_poles(chain: &AxisChain, axis: Vector3<f64>) -> bool {
    let ends = [(0, axis), (1, chain.tool.into_inner())];
    ends.into_iter().all(|(index, vector)| match &chain.rotaries[index] {
        Some(rotary) => rotary.direction.cross(&vector).norm() > UPRIGHT,
        None => true,
    })
}

#[test]
fn random_poses_on_random_chains_come_back() {
    let poses = std::env::var("FILPOST_POSES").ok().and_then(|count| count.parse().ok());
    let mut dice = Dice(0x9e37_79b9_7f4a_7c15);
    let (mut solved, mut limited) = (0u64, 0u64);
    let (mut tip_off, mut axis_off): (f64, f64) = (0.0, 0.0);
    while solved < poses.unwrap_or(POSES) {
        let chain = dice.chain();
        if !is_a_machine(&chain) {
            continue;
        }
        let forward = Forward::new(chain.clone());
        for _ in 0..20 {
            let angles = [dice.within(180.0), dice.within(180.0)];
            let axis = forward.axis(angles);
            let tip = Point3::from(dice.vector(300.0));
            let last = [dice.within(400.0), dice.within(400.0)];
            if !is_off_the_poles(&chain, axis) {
                continue;
            }
            let rotary = match chain.solve(axis, last) {
                Ok(rotary) => rotary,
                Err(diag) => {
                    let bounded = chain.rotaries.iter().flatten().any(|r| r.min.is_some());
                    assert!(diag.code.name() == "E0502" || bounded, "{diag:?} {chain:?} {axis}");
                    assert!(bounded, "{diag:?} {chain:?} {axis}");
                    limited += 1;
                    continue;
                }
            };
            for (rotary, angle) in chain.rotaries.iter().zip(rotary) {
                let Some(rotary) = rotary else { continue };
                let within = rotary.min.is_none_or(|min| angle >= min - 1e-6)
                    && rotary.max.is_none_or(|max| angle <= max + 1e-6);
                assert!(within, "{angle} {rotary:?}");
            }
            let linear = chain.linear(tip, rotary);
            let at = Position { linear: linear.coords.into(), rotary, ..Position::default() };
            let pose = forward.pose(&at);
            let off = ((pose.tip - tip).norm(), (pose.axis - axis).norm());
            assert!(off.0 < 1e-6 && off.1 < 1e-9, "{off:?} {chain:?} {axis} {rotary:?}");
            tip_off = tip_off.max(off.0);
            axis_off = axis_off.max(off.1);
            solved += 1;
        }
    }
    println!("{solved} poses, tip off by {tip_off:e} mm, axis by {axis_off:e}; {limited} limited");
    assert!(limited > 0);
}
