//! Adds, changes and removes people over HTTP.

use std::sync::Arc;

use axum::Json;
use axum::extract::{Path, State};
use axum::http::StatusCode;
use lightbots_api::{AccountRole, NewPerson, PersonChange};

use super::admission::Admission;
use super::refused::{Refused, refuse};
use crate::accounts::{AccountList, Person, check_name};

/// `POST /api/people`: adds a person.
pub async fn add(
    State(admission): State<Arc<Admission>>,
    Json(NewPerson { name, role, password }): Json<NewPerson>,
) -> Result<StatusCode, Refused> {
    check_name(&name).map_err(|line| refuse(StatusCode::UNPROCESSABLE_ENTITY, &line))?;
    let password = hash(&admission, &password).await?;
    change_list(&admission, |list| {
        if list.people.contains_key(&name) {
            let line = format!("{name} is there already: change the role or the password.");
            return Err(refuse(StatusCode::CONFLICT, &line));
        }
        list.people.insert(name, Person { role, password });
        Ok(())
    })
}

/// `PUT /api/people/{name}`: changes the role, the password or both of a person. The last operator keeps that role.
pub async fn change(
    State(admission): State<Arc<Admission>>,
    Path(name): Path<String>,
    Json(PersonChange { role, password }): Json<PersonChange>,
) -> Result<StatusCode, Refused> {
    let password = match password {
        Some(password) => Some(hash(&admission, &password).await?),
        None => None,
    };
    change_list(&admission, |list| {
        if role.is_some_and(|role| role < AccountRole::Operator) {
            keep_an_operator(list, &name)?;
        }
        let person = list.people.get_mut(&name).ok_or_else(|| unknown(&name))?;
        person.role = role.unwrap_or(person.role);
        if let Some(password) = password {
            person.password = password;
        }
        Ok(())
    })
}

/// `DELETE /api/people/{name}`: removes a person, whose sessions and tokens end. Refused for the last operator.
pub async fn remove(
    State(admission): State<Arc<Admission>>,
    Path(name): Path<String>,
) -> Result<StatusCode, Refused> {
    change_list(&admission, |list| {
        keep_an_operator(list, &name)?;
        if list.remove(&name) { Ok(()) } else { Err(unknown(&name)) }
    })
}

/// Changes the accounts by `change`, unless `change` refuses. Returns the status of the answer.
fn change_list(
    admission: &Admission,
    change: impl FnOnce(&mut AccountList) -> Result<(), Refused>,
) -> Result<StatusCode, Refused> {
    let mut refused = None;
    let changed = admission.accounts.change(|list| {
        change(list).map_err(|refusal| {
            refused = Some(refusal);
            String::new()
        })
    });
    match (changed, refused) {
        (_, Some(refusal)) => Err(refusal),
        (Err(line), None) => Err(refuse(StatusCode::INTERNAL_SERVER_ERROR, &line)),
        (Ok(()), None) => Ok(StatusCode::NO_CONTENT),
    }
}

fn keep_an_operator(list: &AccountList, name: &str) -> Result<(), Refused> {
    if list.is_last_operator(name) {
        let line = format!("{name} is the last operator: make another person an operator first.");
        return Err(refuse(StatusCode::CONFLICT, &line));
    }
    Ok(())
}

fn unknown(name: &str) -> Refused {
    refuse(StatusCode::NOT_FOUND, &format!("There is no person {name}."))
}

async fn hash(admission: &Admission, password: &str) -> Result<String, Refused> {
    admission.hash(password).await.map_err(|(status, line)| refuse(status, &line))
}
