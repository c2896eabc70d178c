//! What is known of groups.

use super::*;

#[test]
fn alternatives_of_block_delete_are_both_kept() {
    let one = Know::Known(Plane::Xy);
    assert_eq!(one.join(one), one);
    let either = one.join(Know::Known(Plane::Zx));
    assert_eq!(either.value(), None);
    assert!(either.may_be(Plane::Zx) && !either.may_be(Plane::Yz));
    let open = one.join(Know::Unknown(Source::Author));
    assert!(open.may_be(Plane::Yz));
}

#[test]
fn an_unread_block_leaves_of_each_group_what_its_row_says() {
    let mut groups = Groups::at_start();
    groups.set(PLANE, Plane::Zx);
    groups.set(SPEED_LIMIT, 3000.0);
    groups.set(SURFACE_SPEED, true);
    groups.doubt_all(Source::Author);
    assert_eq!(groups.know(PLANE), Know::Unknown(Source::Author));
    assert_eq!(groups.get(SPEED_LIMIT), Some(3000.0));
    assert_eq!(groups.know(SURFACE_SPEED), Know::Either([Some(true), None]));
}

#[test]
fn a_tool_with_another_offset_depends_on_block_delete() {
    let mut groups = Groups::at_start();
    groups.set(TOOL, 3);
    groups.set(LENGTH_OFFSET, 3);
    let skipped = groups.clone();
    groups.set(LENGTH_OFFSET, 13);
    groups.join(&skipped);
    assert!(groups.depends_on_block_delete(TOOL));
    assert_eq!(groups.get(TOOL), Some(3));
    groups.doubt(TOOL);
    assert!(groups.depends_on_block_delete(TOOL));
}

#[test]
fn a_group_is_usual_by_what_is_known_of_it_last() {
    let set = GroupSet::of(&[Group::Distance, Group::CutterComp]);
    let mut groups = Groups::at_start();
    assert!(groups.are_usual(set));
    groups.set(CUTTER_COMP, Compensation::Left);
    assert!(!groups.are_usual(set));
    let skipped = Groups::at_start();
    groups.join(&skipped);
    assert!(!groups.are_usual(set), "it depends on block delete");
    groups.set(CUTTER_COMP, Compensation::Off);
    assert!(groups.are_usual(set));
    groups.doubt(DISTANCE);
    assert!(!groups.are_usual(set));
    groups.set(DISTANCE, Distance::Absolute);
    groups.doubt_all(Source::Author);
    assert!(!groups.are_usual(set));
}

#[test]
fn a_write_within_a_foreign_block_is_seen() {
    let mut groups = Groups::at_start();
    groups.set(CUTTER_COMP, Compensation::Left);
    groups.foreign_begins();
    assert!(!groups.changed_since_foreign(CUTTER_COMP));
    groups.set(CUTTER_COMP, Compensation::Left);
    assert!(groups.changed_since_foreign(CUTTER_COMP));
}
