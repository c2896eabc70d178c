//! What the back-check says of the plane in which the length of a tool acts, on mills.

use filpost_tests::back_check::{each_is_found, found};

const CL: &str = "LOADTL / 1; SPINDL / RPM, 1000, CLW; FEDRAT / 200, MMPM; RAPID; GOTO / 0, 0, 50; \
                  GOTO / 0, 0, 5; CIRCLE / 10, 0, 5, 0, -1, 0, 10; GOTO / 20, 0, 5; \
                  GOTO / 30, 0, 5; LOADTL / 2; SPINDL / RPM, 900, CLW; RAPID; GOTO / 0, 0, 50; \
                  GOTO / 0, 0, 5";

/// A SINUMERIK counts the length of a milling tool along Y in G18, also while it makes an arc there,
/// unless its setting data hold the lengths fast.
#[test]
fn a_sinumerik_mill_in_another_plane_than_g17_is_found() {
    let nc = "%_N_N_1_MPF; G710 G90 G94 G17; T1 M6; D1; S1000 M3; G0 X0 Y0; Z50; G1 Z5 F200; \
              G18 G2 X20 I10 K0; G17; G1 X30; T2 M6; D1; S900 M3; G0 Z50; X0 Y0; G1 Z5; M30";
    let said = found("sinumerik-840d", &[], CL, nc);
    assert!(said.contains("G18 of line 9 is in force, it should be G17"), "{said}");
    assert_eq!(found("sinumerik-840d", &["tool.length_const=1"], CL, nc), "");
}

/// The same in a motion that no arc asks for it, and of a plane that the program leaves open.
#[test]
fn a_plane_that_stays_on_a_sinumerik_mill_is_found() {
    let cl = "LOADTL / 1; SPINDL / RPM, 1000, CLW; FEDRAT / 200, MMPM; RAPID; GOTO / 0, 0, 50; \
              GOTO / 0, 0, 5; GOTO / 30, 0, 5; RAPID; GOTO / 30, 0, 50";
    let nc = "%_N_N_1_MPF; G710 G90 G94 G17; T1 M6; D1; S1000 M3; G0 X0 Y0; Z50; G1 Z5 F200; X30; \
              G0 Z50; M30";
    let check = |nc: &str| found("sinumerik-840d", &[], cl, nc);
    each_is_found(
        &check,
        nc,
        &[
            (" G17", "", "the plane is left to the control"),
            ("G17", "G19", "G19 of line 2 is in force, it should be G17"),
            ("D1;", "D1; G18;", "G18 of line 5 is in force, it should be G17"),
            ("X30", "G18 X30", "G18 of line 9 is in force, it should be G17"),
        ],
    );
}

/// With parameter 5001 of type B a Fanuc counts a length square to the plane in which G43 stands.
#[test]
fn a_length_that_a_mill_takes_up_in_another_plane_is_found() {
    let nc = "%; O0001 (1); G21 G90 G94 G17; T1 M6; S1000 M3; G0 X0. Y0.; G43 Z50. H1; G1 Z5. F200.; \
              G18 G2 X20. I10. K0.; G1 X30.; G17; T2 M6; S900 M3; G0 G43 Z50. H2; X0. Y0.; G1 Z5.; \
              M30; %";
    for ready in ["fanuc-mill", "haas-mill"] {
        let said = "G18 of line 9 is in force, it should be G17: the lengths of the tool act along \
                    other axes where the length offset was taken up";
        let check = |nc: &str| found(ready, &[], CL, nc);
        each_is_found(&check, nc, &[("; G17; T2", "; T2", said)]);
    }
}
