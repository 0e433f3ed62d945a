//! Roles that requests and operations need, from the table of SECURITY.md. A test of the server checks its cells.

/// Head row of the table.
const HEAD: &str = "| request | before sign-in | viewer | editor | operator |";
/// Names of the roles of the columns, in order.
const COLUMNS: [&str; 4] = ["none", "viewer", "editor", "operator"];

/// Requests and operations, each with the lowest role that may use it.
pub struct Roles(Vec<(String, &'static str)>);

impl Roles {
    /// Reads the roles from the text of SECURITY.md.
    pub fn read(security: &str) -> Self {
        let rows = security.lines().skip_while(|line| *line != HEAD).skip(2);
        let read = rows.take_while(|line| line.starts_with('|')).map(|line| {
            let mut cells = line.trim_matches('|').split('|').map(str::trim);
            let name = cells.next().unwrap_or_default().trim_matches('`').to_owned();
            let first = cells.position(|cell| cell == "yes").expect("each row admits a role");
            (name, COLUMNS[first])
        });
        Self(read.collect())
    }

    /// The routes, such as `GET /api/shows`.
    pub fn routes(&self) -> impl Iterator<Item = &str> {
        self.0.iter().map(|(name, _)| &**name).filter(|name| name.contains(' '))
    }

    /// The lowest role that may use a request or an operation. Panics if the table does not list it.
    pub fn of(&self, name: &str) -> &'static str {
        let found = self.0.iter().find(|(other, _)| other == name);
        found.unwrap_or_else(|| panic!("{name} is missing in the table of SECURITY.md")).1
    }
}
