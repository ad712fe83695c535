//! What the loaders do with files that are wrong: numbers out of range, texts of any kind; and files that are made.

mod any_text_of_a_file_is_read_or_refused;
mod every_number_in_a_file_has_a_range;
mod loaders;
mod robots_in_the_box;
