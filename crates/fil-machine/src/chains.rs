//! Chains of axes that come with the post: `chain = "NAME"` in a `machine.toml` takes one,
//! and what else stands there changes it.

/// A chain that comes with the post.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Chain {
    /// Its name: what carries what, and the letters from the part or the base on.
    pub name: &'static str,
    /// The machine in words.
    pub title: &'static str,
    /// Its settings, as a `machine.toml` has them.
    pub settings: &'static str,
}

/// All of them.
pub const CHAINS: &[Chain] = &[
    Chain {
        name: "table-a",
        title: "four axes, a table A about X",
        settings: "rotary.primary_kind = 1\nrotary.primary_axis = 1\n",
    },
    Chain {
        name: "table-b",
        title: "four axes, a table B about Y",
        settings: "rotary.primary_kind = 1\nrotary.primary_axis = 2\n",
    },
    Chain {
        name: "table-c",
        title: "four axes, a table C about Z and the tool along X",
        settings: "rotary.primary_kind = 1\nrotary.primary_axis = 3\ntool.axis_i = 1.0\n\
                   tool.axis_k = 0.0\n",
    },
    Chain {
        name: "head-b",
        title: "four axes, a head B about Y",
        settings: "rotary.primary_kind = 2\nrotary.primary_axis = 2\n\
                   rotary.primary_min = -110.0\nrotary.primary_max = 110.0\n\
                   rotary.pivot_distance = 200.0\n",
    },
    Chain {
        name: "tables-ca",
        title: "five axes, a table C on a trunnion A",
        settings: "rotary.primary_kind = 1\nrotary.primary_axis = 3\n\
                   rotary.secondary_kind = 1\nrotary.secondary_axis = 1\n\
                   rotary.secondary_min = -120.0\nrotary.secondary_max = 30.0\n",
    },
    Chain {
        name: "tables-cb",
        title: "five axes, a table C on a trunnion B",
        settings: "rotary.primary_kind = 1\nrotary.primary_axis = 3\n\
                   rotary.secondary_kind = 1\nrotary.secondary_axis = 2\n\
                   rotary.secondary_min = -110.0\nrotary.secondary_max = 110.0\n",
    },
    Chain {
        name: "tables-cb-nutating",
        title: "five axes, a table C on a table B that nutates at 45 degrees",
        settings: "rotary.primary_kind = 1\nrotary.primary_axis = 3\n\
                   rotary.secondary_kind = 1\nrotary.secondary_axis = 2\n\
                   rotary.secondary_i = 0.0\nrotary.secondary_j = 1.0\nrotary.secondary_k = 1.0\n\
                   rotary.secondary_min = 0.0\nrotary.secondary_max = 180.0\n",
    },
    Chain {
        name: "table-c-head-b",
        title: "five axes, a table C and a head B",
        settings: "rotary.primary_kind = 1\nrotary.primary_axis = 3\n\
                   rotary.secondary_kind = 2\nrotary.secondary_axis = 2\n\
                   rotary.secondary_min = -30.0\nrotary.secondary_max = 110.0\n\
                   rotary.pivot_distance = 150.0\n",
    },
    Chain {
        name: "heads-ca",
        title: "five axes, a fork C with a head A",
        settings: "rotary.primary_kind = 2\nrotary.primary_axis = 3\n\
                   rotary.secondary_kind = 2\nrotary.secondary_axis = 1\n\
                   rotary.primary_min = -270.0\nrotary.primary_max = 270.0\n\
                   rotary.secondary_min = -120.0\nrotary.secondary_max = 120.0\n\
                   rotary.pivot_distance = 220.0\n",
    },
    Chain {
        name: "heads-cb-nutating",
        title: "five axes, a head C with a head B that nutates at 45 degrees",
        settings: "rotary.primary_kind = 2\nrotary.primary_axis = 3\n\
                   rotary.secondary_kind = 2\nrotary.secondary_axis = 2\n\
                   rotary.secondary_i = 0.0\nrotary.secondary_j = 1.0\nrotary.secondary_k = 1.0\n\
                   rotary.primary_min = -270.0\nrotary.primary_max = 270.0\n\
                   rotary.secondary_min = 0.0\nrotary.secondary_max = 180.0\n\
                   rotary.pivot_distance = 180.0\n",
    },
];

/// The chain of a name.
pub fn find(name: &str) -> Option<&'static Chain> {
    CHAINS.iter().find(|chain| chain.name == name)
}
