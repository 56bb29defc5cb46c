//! The day by the machine's clock and time zone, as ISO 8601 writes it. A browser has its own (`web`).

/// Today.
pub fn today() -> String {
    chrono::Local::now().date_naive().to_string()
}
