//! `passwd`: sets a person's password on this machine.

use std::io::{BufRead, IsTerminal};

use lightbots_api::AccountRole;

use crate::accounts::{Accounts, Person, check_name, check_password, hash_password};
use crate::cli::PasswdArguments;
use crate::data_folder::DataFolder;
use crate::failure::{Failure, Outcome};
use crate::say;

pub fn run(arguments: &PasswdArguments) -> Outcome {
    let PasswdArguments { user, role, data } = arguments;
    check_name(user).map_err(Failure::input)?;
    let password =
        ask(user).map_err(|error| Failure::input(format!("the password cannot be read: {error}")))?;
    check_password(&password).map_err(Failure::input)?;
    let hash = hash_password(&password).map_err(Failure::problem)?;
    let accounts = Accounts::of(&data.clone().unwrap_or_else(DataFolder::usual));
    let changed = accounts.change(|list| {
        let usual = if list.people.is_empty() { AccountRole::Operator } else { AccountRole::Viewer };
        let before = list.people.get(user).map(|person| person.role);
        let role = role.or(before).unwrap_or(usual);
        list.people.insert(user.clone(), Person { role, password: hash });
        Ok((role, before.is_some()))
    });
    let (role, is_known) = changed.map_err(Failure::problem)?;
    let done = if is_known { "has a new password; their sessions have ended" } else { "can sign in" };
    say::line(&format!("{user} ({role}) {done}"));
    Ok(true)
}

/// Reads the password: from the terminal, twice and without echo, or from the first line of the input.
fn ask(user: &str) -> std::io::Result<String> {
    if std::io::stdin().is_terminal() {
        let first = rpassword::prompt_password(format!("New password for {user}: "))?;
        if rpassword::prompt_password("Once more: ")? != first {
            return Err(std::io::Error::other("the two differ; try again"));
        }
        return Ok(first);
    }
    let mut line = String::new();
    std::io::stdin().lock().read_line(&mut line)?;
    Ok(line.trim_end_matches(['\r', '\n']).to_owned())
}
