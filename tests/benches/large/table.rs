//! The table of what was run, as the page of performance shows it.

use std::fmt;

use super::run::Run;

/// A row for each run, with two columns for each size of the CL file.
#[derive(Default)]
pub struct Table {
    /// MB of the CL file, and blocks of its program.
    sizes: Vec<(u64, usize)>,
    rows: Vec<Row>,
}

struct Row {
    name: String,
    /// Two texts for each size, empty where it was not run.
    cells: Vec<[String; 2]>,
}

impl Table {
    /// What comes next is run on a CL file of a size.
    pub fn size(&mut self, megabytes: u64, blocks: usize) {
        self.sizes.push((megabytes, blocks));
    }

    /// Takes up a run.
    pub fn ran(&mut self, name: &str, ran: &Run) {
        let cells = [format!("{:.3}", ran.seconds), format!("{:.0}", ran.memory)];
        self.put(format!("`{name}`"), cells);
    }

    /// Takes up the page that a run made, by its bytes.
    pub fn page(&mut self, name: &str, bytes: u64) {
        let cells = [format!("{:.1}", bytes as f64 / 1e6), String::new()];
        self.put(format!("page of `{name}`, MB"), cells);
    }

    fn put(&mut self, name: String, cells: [String; 2]) {
        let at = self.rows.iter().position(|row| row.name == name);
        let at = at.unwrap_or_else(|| {
            self.rows.push(Row { name, cells: Vec::new() });
            self.rows.len() - 1
        });
        let row = &mut self.rows[at];
        row.cells.resize(self.sizes.len() - 1, Default::default());
        row.cells.push(cells);
    }
}

impl fmt::Display for Table {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(to, "| run |")?;
        for (megabytes, blocks) in &self.sizes {
            write!(to, " {megabytes} MB of CL, {blocks} blocks: seconds | MiB |")?;
        }
        writeln!(to, "\n|---|{}", "---|---|".repeat(self.sizes.len()))?;
        for row in &self.rows {
            write!(to, "| {} |", row.name)?;
            for at in 0..self.sizes.len() {
                let [first, second] = row.cells.get(at).cloned().unwrap_or_default();
                write!(to, " {first} | {second} |")?;
            }
            writeln!(to)?;
        }
        Ok(())
    }
}
