//! Files take their names one after the other; until the last one has, each can go back.

use std::io;
use std::path::PathBuf;

use super::new_file::{NewFile, free_name};
use super::place::Place;
use super::unfinished::{self, Action, Ticket};
use crate::error::Error;
use crate::files::cant_write;

/// The steps back. Dropping this takes them.
#[derive(Default)]
pub(super) struct Undo {
    steps: Vec<Ticket>,
    /// Old files under another name.
    old: Vec<(Place, PathBuf)>,
}

impl Undo {
    /// Gives a file its name; an old one of that name is kept under another.
    pub fn put(&mut self, file: NewFile) -> Result<(), Error> {
        let (place, beside, ticket) = file.into_parts();
        let put = || {
            if place.is_taken()? {
                self.set_aside(&place)?;
            }
            let folder = &place.folder;
            let remove = Action::Remove { folder: folder.clone(), name: place.name.clone() };
            unfinished::instead(ticket, remove, || folder.rename(&beside, folder, &place.name))
        };
        let ((), step) = put().map_err(|error| {
            let _ = place.folder.remove_file(&beside);
            cant_write(place.path(), &error)
        })?;
        self.steps.push(step);
        Ok(())
    }

    /// Takes a file away, if it is there.
    pub fn delete(&mut self, place: Place) -> Result<(), Error> {
        let mut gone = || {
            if !place.is_taken()? {
                return Ok(());
            }
            self.set_aside(&place)?;
            match place.folder.remove_file(&place.name) {
                Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
                _ => Ok(()),
            }
        };
        gone().map_err(|error| cant_write(place.path(), &error))
    }

    /// Gives a file a second name, where the file system has such, so that the first is
    /// never without a file; else another one.
    fn set_aside(&mut self, place: &Place) -> io::Result<()> {
        let folder = &place.folder;
        let aside = place.sibling(&free_name());
        let (name, from) = (place.name.clone(), aside.clone());
        let restore = Action::Restore { folder: folder.clone(), from, name };
        let ((), step) = unfinished::with(restore, || {
            let linked = folder.hard_link(&place.name, folder, &aside);
            linked.or_else(|_| folder.rename(&place.name, folder, &aside))
        })?;
        self.steps.push(step);
        self.old.push((place.clone(), aside));
        Ok(())
    }

    /// All went well: the old files go.
    pub fn forget(mut self) {
        self.steps.drain(..).for_each(Ticket::forget);
        for (place, aside) in self.old.drain(..) {
            let _ = place.folder.remove_file(aside);
        }
    }
}

impl Drop for Undo {
    fn drop(&mut self) {
        self.steps.drain(..).rev().for_each(Ticket::run);
    }
}
