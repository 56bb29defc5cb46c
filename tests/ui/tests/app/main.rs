//! The app without a window: its controls, keys, views and trial, driven as assistive tools drive them.

mod compare;
mod controls;
mod device;
mod keys;
mod recovery;
mod sharing;
mod trial;
mod verdict;
mod vessels;
