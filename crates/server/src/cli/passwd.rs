//! The arguments of `passwd`.

use std::path::PathBuf;

use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use lightbots_api::AccountRole;

/// `passwd`
#[derive(Debug, Args)]
pub struct PasswdArguments {
    /// Name of the person
    pub user: String,
    /// The person's role [default: as before; operator for the first person, viewer for others]
    #[arg(long, value_name = "ROLE", value_parser = roles())]
    pub role: Option<AccountRole>,
    /// Folder of the library, where accounts are kept [default: lightbots in the user's data folder]
    #[arg(long, value_name = "DIR")]
    pub data: Option<PathBuf>,
}

/// Returns a parser of role names, which `--help` then lists.
fn roles() -> impl TypedValueParser<Value = AccountRole> {
    PossibleValuesParser::new(AccountRole::ALL.map(AccountRole::name))
        .try_map(|text| text.parse::<AccountRole>())
}
