// The settings of the form: their sections in order, and those that shops change.

/** The first part of a key and its title, in the order in which an option file's report has its sections. */
export const SECTIONS = new Map(Object.entries({
  // General information.
  control: "Control", units: "Units",
  // Machine configuration.
  rotary: "Rotary axes", motion: "Motion", limits: "Travel", home: "Home and retract", input: "Input", scale: "Scale", output: "Output",
  // Mill-turn; REPOS.
  mill_turn: "Mill-turn", lathe: "Lathe", repos: "Reposition",
  // MCD file; files.
  tape: "Text of the program", list: "Listing", seqno: "Block numbers", package: "Package",
  // Prep codes; coolant codes.
  mode: "Modes at the start", coolant: "Coolant",
  // Linear, rapid, circular and cycle motion.
  linear: "Straight moves", rapid: "Rapid traverse", circle: "Arcs", cycle: "Cycles", thread: "Threads",
  feed: "Feed", override: "Override", cutcom: "Radius compensation", tool: "Tools", turret: "Turret",
  fixture: "Work offsets", spindle: "Spindle", dwell: "Dwell", message: "Messages",
  // Start and end of the program.
  program: "Program",
}));

/** What shops change: all that `filpost new` proposes, and what newcomers look for. */
export const COMMON = new Set([
  "units.mode", "limits.check", "limits.x_min", "limits.x_max", "limits.y_min", "limits.y_max", "limits.z_min", "limits.z_max",
  "home.frame", "home.x", "home.y", "home.z", "home.retract_z",
  "tape.line_end", "tape.decimal_rule", "tape.blank", "seqno.increment", "seqno.start_offset", "seqno.off_at_start", "seqno.on_text",
  "coolant.default_code", "coolant.flood_code", "coolant.mist_code", "coolant.thru_high_code", "coolant.off_code",
  "rapid.rate", "rapid.split", "circle.center", "circle.chord_tolerance", "cycle.tap_rigid", "cycle.rigid_tap_mode", "feed.upm_max",
  "tool.change_time", "tool.change_stop", "tool.preselect", "tool.preselect_first", "fixture.first",
  "spindle.stop_code", "spindle.range1_max", "spindle.css_limit", "message.waits",
  "program.number", "program.number_digits", "program.name_comment", "program.tool_list", "program.safe_start", "program.end_block", "program.end_code", "program.rewind_code",
]);
