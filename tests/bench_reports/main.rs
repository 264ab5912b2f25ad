//! What becomes of records: tables, CSV, pages, comparisons. Nothing is measured here.

mod compare;
mod csv;
mod html;
mod lone;
mod program;
mod schema;
mod synthetic;
mod table;
