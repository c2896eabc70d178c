//! Texts that a reader could take for something else: each is read as the GOTO it holds, or
//! refused with a code.

use fil_cl::{Options, Reader, Record, Vocabulary};

/// Points of all GOTO records, or the code of the refusal.
fn read(text: &str) -> Result<Vec<[f64; 3]>, u16> {
    let mut reader = Reader::new(text.as_bytes(), "t", Options::default());
    let (mut vocab, mut record) = (Vocabulary::new(), Record::default());
    let mut points = Vec::new();
    while reader.read(&mut vocab, &mut record).map_err(|diag| diag.code.number)? {
        points.extend(record.point());
    }
    Ok(points)
}

/// What is between RAPID and FINI is GOTO / 1, 2, 3 and nothing else.
#[test]
fn one_point_in_many_layouts() {
    for text in [
        "GOTO/1,2,3",
        "goto/1,2,3",
        "   GoTo / 1. , 2. , 3.   ",
        "\tGOTO\t/\t1,\t2,\t3\t",
        "GO TO/1,2,3",
        "GOTO/1.D0,+2.E0,30.0E-1",
        "GOTO/01,2.,00003",
        "GOTO/1,2,$\n3",
        "GOTO/1,2,$\n\n\n   3",
        "GOTO/1,2,$\n$$ a comment\n$$ another $\n3",
        "GOTO/1,2,  $ $$ a comment\n 3",
        "GOTO / $\n1 $\n, 2 $\n, 3",
        "GOTO/1,2,3 $$ GOTO/4,5,6",
        "GOTO/1,2,3 $$$",
        "$$ GOTO/4,5,6\nGOTO/1,2,3",
        "$$ a comment $\nGOTO/1,2,3",
        "  $$-> GOTO / 4, 5, 6\nGOTO/1,2,3",
        "$\nGOTO/1,2,3",
        "PPRINT/ 'GOTO/4,5,6'\nGOTO/1,2,3",
        "PPRINT/ COST $$ 5 $\nGOTO/1,2,3",
        "INSERT G1 X5$\nGOTO/1,2,3",
        "PARTNO A/B $$-> C\nGOTO/1,2,3",
        "REMARK GOTO/4,5,6\nGOTO/1,2,3",
        "PPRINT\nGOTO/1,2,3",
        "CYCLE/DRILL,DEPTH,5,$\n$$ c\nCLEAR,2\nGOTO/1,2,3",
        "UNHEARD/OF,(1,2),a=b\nGOTO/1,2,3",
    ] {
        for end in ["\n", "\r\n", "\r\r\n", " \t\r\n"] {
            let text = format!("\u{FEFF}RAPID\n{text}\nFINI\n").replace('\n', end);
            assert_eq!(read(&text), Ok(vec![[1.0, 2.0, 3.0]]), "{text:?}");
        }
    }
    let header = "$$ x\n".repeat(8000) + &"$$ ".repeat(9000) + "\n";
    assert_eq!(read(&(header + "GOTO/1,2,3\n")), Ok(vec![[1.0, 2.0, 3.0]]));
}

/// Never another point, and never none.
#[test]
fn what_is_refused() {
    for (text, code) in [
        // Numbers.
        ("GOTO/1.2.3,2,3", 405),
        ("GOTO/1E999,2,3", 405),
        ("GOTO/--5,2,3", 405),
        ("GOTO/+-3,2,3", 405),
        ("GOTO/- 5,2,3", 405),
        ("GOTO/1 000.5,2,3", 405),
        ("GOTO/0x10,2,3", 405),
        ("GOTO/1.5-101,2,3", 405),
        ("GOTO/1,2,3;", 405),
        ("GOTO/1,2,3                          00010", 405),
        ("GOTO/1,2,3$\n4", 405),
        ("GOTO/******,2,3", 406),
        ("GOTO/#1,2,3", 406),
        ("GOTO/INF,2,3", 407),
        ("GOTO/\u{2212}1,2,3", 407),
        ("GOTO/\u{A0}1,2,3", 406),
        ("GOTO/1,5,2,5,3,5", 416),
        // Items.
        ("GOTO/1,,3", 407),
        ("GOTO/,1,2,3", 407),
        ("GOTO/1,2,3,", 418),
        ("GOTO/1,2,\n3", 418),
        ("GOTO/1,2", 407),
        ("GOTO/1,2,3,4", 407),
        ("GOTO/1,2,3,4,5,6", 416),
        ("GOTO/1,2,3,4,5,6,7,8,9", 407),
        ("GOTO/1,2,3,0,0,1,4,5,6,0,0,1", 407),
        ("GOTO//1,2,3", 406),
        ("GOTO/(1,2,3)", 406),
        ("GOTO/", 407),
        ("GOTO", 407),
        ("FEDRAT", 418),
        // Words.
        ("GOTO 1,2,3", 406),
        ("GOTO,1,2,3", 406),
        ("GOTO=1,2,3", 406),
        ("RAPID GOTO/1,2,3", 406),
        ("RAPID,GOTO/1,2,3", 406),
        ("RAPID $\nGOTO/1,2,3", 406),
        ("RAPID; GOTO/1,2,3", 406),
        ("RAPID 5", 406),
        ("L1)GOTO/1,2,3", 406),
        ("; GOTO/1,2,3", 406),
        ("1,2,3", 406),
        ("a line of prose", 406),
        ("CYCLE/'DRILL'", 406),
        ("\u{FEFF}GOTO/1,2,3", 406),
        ("G\u{41E}TO/1,2,3", 406),
        ("INSERTG0 X5", 406),
        ("INSERT /M30", 406),
        ("PPRINT,X", 406),
        // Lines.
        ("GOTO/1,2,3 $", 405),
        ("$$ a comment\rGOTO/1,2,3", 402),
        ("RAPID $$ a comment\rGOTO/1,2,3", 402),
        ("PPRINT A\rGOTO/1,2,3", 402),
        ("GOTO/1,2,3\u{B}GOTO/4,5,6", 402),
        ("\u{C}GOTO/1,2,3", 402),
        ("\u{1A}GOTO/1,2,3", 402),
        ("PPRINT A\0B", 402),
        ("GOTO/1,2,$\n$$-> END /\n3", 404),
        // Dialects.
        ("CIRCLE/0,0,0,0,0,1,5,.06,.5,10,1", 417),
        ("CIRCLE/0,0,0,0,0,1,5,CLOCKWISE", 417),
        ("CIRCLE/0,0,0,0,0,5", 407),
        ("CIRCLE/0,0,0,0,0", 407),
        ("PAINT/A\n$$-> END /", 415),
        ("INDIRV/1,0,0", 418),
    ] {
        let text = format!("RAPID\n{text}\nRAPID\nFINI\n");
        assert_eq!(read(&text), Err(code), "{text:?}");
    }
}
