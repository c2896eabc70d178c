//! CL texts as the systems write them, to measure how fast they are read: of ten motions
//! two are rapid and one is an arc, and words that only inform stand between them.

use std::io::{self, Write};

use fil_cl::ClDialect;

/// Writes the statements of a motion that begins or ends at a point.
type Motion = fn([f64; 3], &mut dyn Write) -> io::Result<()>;

/// What a system writes.
struct Layout {
    head: &'static str,
    /// Before the rapid motions of a row; `#` stands for the number of the row.
    begin: &'static str,
    /// A motion to the point.
    goto: Motion,
    feed: &'static str,
    /// A half circle from the point to the one with x 10 greater, without its GOTO.
    arc: Option<Motion>,
    /// The arc's statements end it themselves.
    arc_has_end: bool,
    foot: &'static str,
}

/// Writes a text of a dialect with at least so many lines; gives how many it has.
///
/// # Errors
/// Those of the output; a dialect that no text is known of.
pub fn write(dialect: ClDialect, lines: u64, output: &mut dyn Write) -> io::Result<u64> {
    let layout = layout(dialect)?;
    let mut counted = Counted { output, lines: 0 };
    counted.write_all(layout.head.as_bytes())?;
    let mut row = 0;
    while counted.lines < lines {
        write_row(&layout, row, &mut counted)?;
        row += 1;
    }
    counted.write_all(layout.foot.as_bytes())?;
    Ok(counted.lines)
}

fn write_row(layout: &Layout, row: u64, output: &mut dyn Write) -> io::Result<()> {
    // A part has some hundred operations at most, each with its name.
    let (row, y) = (row % 500, (row % 4000) as f64 * 0.025);
    output.write_all(layout.begin.replace('#', &row.to_string()).as_bytes())?;
    for height in [50.0, 2.0] {
        output.write_all(b"RAPID\n")?;
        (layout.goto)([0.0, y, height], output)?;
    }
    output.write_all(layout.feed.as_bytes())?;
    for along in 0..7 {
        let x = f64::from(along) * 1.731;
        (layout.goto)([x, y, -2.5 + x * 0.0137], output)?;
    }
    if let Some(arc) = layout.arc {
        (layout.goto)([20.0, y, -2.5], output)?;
        arc([20.0, y, -2.5], output)?;
        if !layout.arc_has_end {
            (layout.goto)([30.0, y, -2.5], output)?;
        }
    }
    Ok(())
}

/// Counts the lines that go through it.
struct Counted<'a> {
    output: &'a mut dyn Write,
    lines: u64,
}

impl Write for Counted<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let count = self.output.write(bytes)?;
        self.lines += bytes[..count].iter().filter(|byte| **byte == b'\n').count() as u64;
        Ok(count)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.output.flush()
    }
}

fn layout(dialect: ClDialect) -> io::Result<Layout> {
    let creo = Layout {
        head: "$$*          Pro/CLfile  Version 8.0 - 8.0.3.0\nPARTNO / PART\nUNITS / MM\nLOADTL / 1\n",
        begin: "$$-> FEATNO / #\n",
        goto: |[x, y, z], output| writeln!(output, "GOTO / {x:.10}, {y:.10}, {z:.10}"),
        feed: "FEDRAT / 400.000000,  MMPM\n",
        arc: Some(|[x, y, z], output| {
            let center = x + 5.0;
            writeln!(output, "CIRCLE / {center:.10}, {y:.10}, {z:.10},  $")?;
            writeln!(output, "0.0000000000, 0.0000000000, 1.0000000000,  5.0000000000")
        }),
        arc_has_end: false,
        foot: "FINI\n",
    };
    Ok(match dialect {
        ClDialect::Creo => creo,
        ClDialect::Generic => {
            Layout { head: "PARTNO / PART\nUNITS / MM\nLOADTL / 1\n", begin: "", ..creo }
        }
        ClDialect::Nx => Layout {
            head: "TOOL PATH/A_1,TOOL,T1\nUNITS/MM\nLOAD/TOOL,1\n",
            begin: "PAINT/COLOR,#\n",
            goto: plain,
            feed: "FEDRAT/MMPM,400.0000\n",
            arc: Some(|[x, y, z], output| {
                let center = x + 5.0;
                writeln!(
                    output,
                    "CIRCLE/{center:.4},{y:.4},{z:.4},0.0000000,0.0000000,-1.0000000,5.0000,0.0600,0.5000,20.0000,0.0000"
                )
            }),
            foot: "END-OF-PATH\n",
            ..creo
        },
        ClDialect::Ffcam => Layout {
            head: "PPRINT/APTCL-SPEC,MAKINO-FF,1\nUNITS/MM\nLOAD/TOOL,1\n",
            begin: "PPRINT/BEGIN-SECTION,PATH\n",
            goto: |[x, y, z], output| writeln!(output, "GOTO/{x:.7},{y:.7},{z:.7}"),
            feed: "FEDRAT/PERMIN,400.0\n",
            arc: Some(|[x, y, z], output| {
                let center = x + 5.0;
                writeln!(
                    output,
                    "CIRCLE/{center:.7},{y:.7},{z:.7},0.0000000,0.0000000,-1.0000000,5.0,0.0600,0.5000,20.0000,0.0000"
                )
            }),
            foot: "FINI\n",
            ..creo
        },
        ClDialect::Catia => Layout {
            head: "$$     CATIA APT VERSION 1.0\nPARTNO/PART\nUNITS/MM\nLOADTL/1\nMULTAX/ON\n",
            begin: "$$ OPERATION NAME : Milling.#\nOP_NAME/Milling.#\n",
            goto: |[x, y, z], output| {
                writeln!(output, "GOTO  / {x:.5}, {y:.5}, {z:.5}, 0.000000, 0.000000, 1.000000")
            },
            feed: "FEDRAT/  400.0000,MMPM\n",
            arc: Some(|[x, y, z], output| {
                let center = x + 5.0;
                writeln!(output, "INDIRV/   0.00000, -1.00000, 0.00000")?;
                writeln!(output, "TLON,GOFWD/ (CIRCLE/ {center:.5}, {y:.5}, {z:.5},$")?;
                writeln!(output, " 5.00000),ON,(LINE/ {center:.5}, {y:.5}, {z:.5},$")?;
                writeln!(output, " {:.5}, {y:.5}, {z:.5})", x + 10.0)
            }),
            arc_has_end: true,
            foot: "END\n",
        },
        ClDialect::SolidWorksCam => Layout {
            head: "PARTNO/1\nUNIT/MM\nTRNTYP/WORLD,0,0,0\nLOAD/TOOL,1\n",
            begin: "CSI_SET_FLUTE_LENGTH/143.\n",
            goto: plain,
            feed: "FEDRAT/400.,MMPM\n",
            arc: Some(|[x, y, z], output| {
                writeln!(output, "CIRCLE/{:.4},{y:.4},{z:.4},0,0,1.", x + 5.0)
            }),
            ..creo
        },
        ClDialect::CamWorks => Layout {
            head: "UNITS/ MM \nBOX/ 0.000000,0.000000,0.000000,90.000000,3.000000,55.000000 \nLOADTL/1\n",
            begin: "OPFEATSTART/Mill#-Hole#\n",
            goto: |[x, y, z], output| writeln!(output, "GOTO/ {x:.6},{y:.6},{z:.6} "),
            feed: "FEDRAT/ 400.000000,MMPM \n",
            arc: Some(|[x, y, z], output| {
                let center = x + 5.0;
                writeln!(
                    output,
                    "CIRCLE/ {center:.6},{y:.6},{z:.6},0.000000,0.000000,1.000000,5.000000,COUNTERCLOCKWISE "
                )
            }),
            ..creo
        },
        ClDialect::Ncl => Layout {
            head: "REMARK/ NCLCAM\nPARTNO/PART\nUNITS/MM\nLOADTL/1\n",
            begin: "REMARK/ row #\n",
            goto: plain,
            feed: "FEDRAT/400.,MMPM\n",
            arc: None,
            ..creo
        },
        other => return Err(io::Error::other(format!("no text is known of {other}"))),
    })
}

fn plain([x, y, z]: [f64; 3], output: &mut dyn Write) -> io::Result<()> {
    writeln!(output, "GOTO/{x:.4},{y:.4},{z:.4}")
}
