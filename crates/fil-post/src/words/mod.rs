//! The post words, one file each: what a CL record makes the machine do.
//!
//! A handler takes the items it understands from the record and makes operations;
//! the index of all words is in [`dispatch`](crate::dispatch).

pub mod arcslp;
pub mod circle;
pub mod clamp;
pub mod coolnt;
pub mod csys;
pub mod cutcom;
pub mod cutter;
pub mod cycle;
pub mod delay;
pub mod end;
pub mod fedrat;
pub mod from;
pub mod godlta;
pub mod goto;
pub mod home;
pub mod insert;
pub mod lintol;
pub mod loadtl;
pub mod mode;
pub mod multax;
pub mod op;
pub mod opskip;
pub mod partno;
pub mod plabel;
pub mod postn;
pub mod pprint;
pub mod prefun;
pub mod pseudo;
pub mod rapid;
pub mod repeat;
pub mod replac;
pub mod rotabl;
pub mod seqno;
pub mod set;
pub mod spindl;
pub mod stop;
pub mod thread;
pub mod trans;
pub mod units;
