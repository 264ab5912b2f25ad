//! The record's JSON Schema and the record agree.
