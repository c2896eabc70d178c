//! Where a run spends its time: by CL word, section and line of FIL.
//!
//! A [`Profile`] is the debugger of one run. What a statement has the post do counts as time
//! of the statement; what it takes to look at the clock does not count.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::time::{Duration, Instant};

use fil_diag::Diag;

use crate::debug::{DebugEvent, DebugState, Debugger};
use crate::program::Program;

/// What time is spent on.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
enum Spent {
    /// Reading CL text, and everything between two records.
    Reading,
    /// A CL record, by its major word.
    Record(String),
    /// A section or macro, by its number.
    Part(usize),
    /// A line of FIL: file and line.
    Line(u16, u32),
}

/// A node of the tree of calls.
#[derive(Clone, Debug)]
struct Node {
    spent: Spent,
    children: Vec<usize>,
    own: Duration,
    count: u64,
}

/// Takes the time of a run.
#[derive(Clone, Debug)]
pub struct Profile {
    nodes: Vec<Node>,
    /// From the root to what runs.
    open: Vec<usize>,
    since: Instant,
}

/// Time of a section, a line or a word.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Row {
    /// What: `section CYCLE`, `post.fil:12`, `GOTO`.
    pub name: String,
    /// How often.
    pub count: u64,
    /// With all that it called.
    pub total: Duration,
    /// Without the lines and macros that it called.
    pub own: Duration,
}

impl Default for Profile {
    fn default() -> Self {
        let root =
            Node { spent: Spent::Reading, children: Vec::new(), own: Duration::ZERO, count: 1 };
        Profile { nodes: vec![root], open: vec![0], since: Instant::now() }
    }
}

impl Debugger for Profile {
    fn at(
        &mut self,
        event: DebugEvent<'_>,
        state: &mut DebugState<'_, '_>,
    ) -> Result<(), Box<Diag>> {
        let now = Instant::now();
        let top = self.top();
        self.nodes[top].own += now - self.since;
        match event {
            DebugEvent::Record => {
                self.open.truncate(1);
                let major = state.fil.record.as_deref().map(|record| record.major);
                let name = major.map_or("", |major| state.fil.vocabulary.name(major));
                self.begin(Spent::Record(name.to_string()));
            }
            DebugEvent::RecordDone => self.open.truncate(1),
            DebugEvent::Enter => {
                if let Some(part) = state.fil.part() {
                    self.begin(Spent::Part(part));
                }
            }
            DebugEvent::Statement => {
                self.end_line();
                if let Some((file, line)) = state.fil.line() {
                    self.begin(Spent::Line(file, line));
                }
            }
            DebugEvent::Leave => {
                self.end_line();
                if self.open.len() > 1 {
                    self.open.pop();
                }
            }
            _ => {}
        }
        self.since = Instant::now();
        Ok(())
    }
}

impl Profile {
    fn top(&self) -> usize {
        self.open.last().copied().unwrap_or(0)
    }

    fn begin(&mut self, spent: Spent) {
        let top = self.top();
        let known = self.nodes[top].children.iter().copied();
        let mut known = known.filter(|child| self.nodes[*child].spent == spent);
        let node = known.next().unwrap_or_else(|| {
            self.nodes.push(Node { spent, children: Vec::new(), own: Duration::ZERO, count: 0 });
            let node = self.nodes.len() - 1;
            self.nodes[top].children.push(node);
            node
        });
        self.nodes[node].count += 1;
        self.open.push(node);
    }

    fn end_line(&mut self) {
        if matches!(self.nodes[self.top()].spent, Spent::Line(..)) {
            self.open.pop();
        }
    }

    fn total(&self, node: usize) -> Duration {
        let Node { own, children, .. } = &self.nodes[node];
        *own + children.iter().map(|child| self.total(*child)).sum::<Duration>()
    }

    /// Time of the whole run.
    pub fn whole(&self) -> Duration {
        self.total(0)
    }

    /// Time of the CL records by their major words, longest first. What their sections take
    /// is in it.
    pub fn words(&self, program: &Program) -> Vec<Row> {
        self.rows(program, |spent| matches!(spent, Spent::Record(_)))
    }

    /// Time of sections, macros and global areas, longest first.
    pub fn sections(&self, program: &Program) -> Vec<Row> {
        self.rows(program, |spent| matches!(spent, Spent::Part(_)))
    }

    /// Time of the lines of FIL, longest first.
    pub fn lines(&self, program: &Program) -> Vec<Row> {
        self.rows(program, |spent| matches!(spent, Spent::Line(..)))
    }

    fn rows(&self, program: &Program, is_meant: fn(&Spent) -> bool) -> Vec<Row> {
        let names = Names::of(program);
        let mut rows: BTreeMap<&Spent, Row> = BTreeMap::new();
        for (number, node) in self.nodes.iter().enumerate() {
            if !is_meant(&node.spent) {
                continue;
            }
            let row = rows.entry(&node.spent).or_insert_with(|| Row {
                name: names.name(&node.spent),
                count: 0,
                total: Duration::ZERO,
                own: Duration::ZERO,
            });
            row.count += node.count;
            row.total += self.total(number);
            row.own += node.own;
        }
        let mut rows: Vec<Row> = rows.into_values().collect();
        rows.sort_by(|one, other| other.total.cmp(&one.total).then(one.name.cmp(&other.name)));
        rows
    }

    /// The tree of calls as a flame graph: an SVG picture, width by time.
    pub fn flame_graph(&self, program: &Program) -> String {
        let names = Names::of(program);
        let whole = self.whole().as_secs_f64().max(1e-9);
        let height = f64::from(self.depth(0)) * ROW + 40.0;
        let mut svg = String::new();
        // Writing to a text can't fail.
        let _ = write!(
            svg,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height}\" \
             font-family=\"sans-serif\" font-size=\"11\">\n<text x=\"4\" y=\"16\">{}, {} CL \
             words and lines of FIL; point at a bar to read it</text>\n",
            time(self.whole()),
            self.nodes.len() - 1
        );
        self.bar(0, 0.0, 24.0, WIDTH / whole, &names, &mut svg);
        svg.push_str("</svg>\n");
        svg
    }

    fn depth(&self, node: usize) -> u32 {
        1 + self.nodes[node].children.iter().map(|child| self.depth(*child)).max().unwrap_or(0)
    }

    fn bar(&self, node: usize, x: f64, y: f64, scale: f64, names: &Names, svg: &mut String) {
        let total = self.total(node);
        let width = total.as_secs_f64() * scale;
        if width < 0.2 {
            return;
        }
        let name = if node == 0 { "run".to_string() } else { names.name(&self.nodes[node].spent) };
        let color = match self.nodes[node].spent {
            Spent::Reading => "#d9d9d9",
            Spent::Record(_) => "#9ecae1",
            Spent::Part(_) => "#fdae6b",
            Spent::Line(..) => "#fdd0a2",
        };
        let (name, count) = (escaped(&name), self.nodes[node].count);
        let share = 100.0 * width / WIDTH;
        let _ = write!(
            svg,
            "<g><title>{name}: {}, {share:.1} %, {count} times</title><rect x=\"{x:.2}\" \
             y=\"{y}\" width=\"{width:.2}\" height=\"{}\" fill=\"{color}\" stroke=\"white\" \
             stroke-width=\"0.5\"/>",
            time(total),
            ROW - 1.0
        );
        // About 6 units a letter; a text that is cut short says nothing.
        if width > 6.0 * name.chars().count() as f64 + 6.0 {
            let _ = write!(svg, "<text x=\"{:.2}\" y=\"{}\">{name}</text>", x + 3.0, y + 13.0);
        }
        svg.push_str("</g>\n");
        let mut at = x;
        for child in &self.nodes[node].children {
            self.bar(*child, at, y + ROW, scale, names, svg);
            at += self.total(*child).as_secs_f64() * scale;
        }
    }
}

/// Width of the picture and height of a row, in its own units.
const WIDTH: f64 = 1200.0;
const ROW: f64 = 18.0;

/// A time for people.
pub fn time(time: Duration) -> String {
    let seconds = time.as_secs_f64();
    if seconds >= 1.0 {
        format!("{seconds:.2} s")
    } else if seconds >= 1e-3 {
        format!("{:.2} ms", seconds * 1e3)
    } else {
        format!("{:.1} µs", seconds * 1e6)
    }
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

/// What sections and files are called.
struct Names {
    files: Vec<String>,
    parts: Vec<String>,
}

impl Names {
    fn of(program: &Program) -> Names {
        let outline = program.shared.module.outline();
        let parts = outline.parts.into_iter().map(|part| part.title).collect();
        Names { files: program.fil_files(), parts }
    }

    fn name(&self, spent: &Spent) -> String {
        match spent {
            Spent::Reading => "reading".to_string(),
            Spent::Record(word) => word.clone(),
            Spent::Part(part) => self.parts.get(*part).cloned().unwrap_or_default(),
            Spent::Line(file, line) => {
                let file = self.files.get(usize::from(*file)).map_or("", String::as_str);
                format!("{file}:{line}")
            }
        }
    }
}
