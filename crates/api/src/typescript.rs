//! The messages as TypeScript types.

use lightbots_exchange::{FORMATS, Format, MAX_BYTES, Part};
use ts_rs::{Config, TS};

use crate::{
    Abilities, AccountEntry, AccountRole, Answer, BeatsAnswer, Broker, BrokerPhase, BrokerSettings, Choice,
    Credentials, FilmAnswer, FilmPicture, FirstOperator, FitAnswer, Fleet, FleetRow, FromScreen, Hello,
    Incident, IncidentTone, Incidents, Issue, Level, LightAnswer, LightRequest, LogLine, MadePixel,
    MadeReadability, MadeToken, MakeAnswer, MakeChoices, MakeFile, MakeFont, MakeQuality, MakeRemark,
    MakeRequest, MakeShape, Missing, MovedAnswer, MovedPixel, NewPerson, OpenShow, Operation, Path,
    PersonChange, Phase, Plan, PlanAnswer, PlanningRequest, Playback, PlaylistChange, PlaylistDay,
    PlaylistEntry, PlaylistNext, PlaylistResult, PlaylistState, PlaylistToday, PreflightFault,
    PreflightResult, PreflightState, Presence, Problem, RefusedOperation, Repeats, Request, RobotStatus,
    Robots, RunEntry, RunEntryKind, Severity, ShowEntry, ShowOrigin, ShowState, ShowTime, State, ToScreen,
    Transition, Whoami,
};

/// The first line of the generated file.
const HEAD: &str =
    "// Made from crates/api by `cargo run -p lightbots-api --example types`. Change it there.\n";

/// Returns the TypeScript of the named types, each with its documentation.
macro_rules! declarations {
    ($($name:ty),* $(,)?) => {{
        let config = Config::new().with_large_int("number");
        let each = [$((<$name as TS>::docs(), <$name as TS>::decl(&config))),*];
        each.map(|(docs, declaration)| format!("\n{}export {declaration}\n", docs.unwrap_or_default())).concat()
    }};
}

/// The text of `ui/src/api/types.gen.ts`: the types that screen, server and the module in the browser exchange, each
/// with its documentation. Also the columns of the binary message, and the table of formats.
pub fn typescript() -> String {
    [HEAD, &messages(), &module(), &robots(), &formats()].concat()
}

/// The types that screen and server exchange, as TypeScript.
fn messages() -> String {
    declarations!(
        ToScreen,
        FromScreen,
        Hello,
        OpenShow,
        Plan,
        PlanningRequest,
        PlanAnswer,
        LightRequest,
        LightAnswer,
        Transition,
        Path,
        Issue,
        Severity,
        Fleet,
        FleetRow,
        PreflightResult,
        PreflightFault,
        RobotStatus,
        Presence,
        Abilities,
        State,
        Broker,
        BrokerPhase,
        BrokerSettings,
        Playback,
        PreflightState,
        Repeats,
        ShowTime,
        Phase,
        Robots,
        LogLine,
        Level,
        Incidents,
        Incident,
        IncidentTone,
        Request,
        Operation,
        Missing,
        Answer,
        Choice,
        ShowEntry,
        ShowOrigin,
        ShowState,
        RunEntry,
        RunEntryKind,
        Problem,
        PlaylistChange,
        PlaylistEntry,
        PlaylistDay,
        PlaylistState,
        PlaylistToday,
        PlaylistResult,
        PlaylistNext,
        RefusedOperation,
        AccountRole,
        Whoami,
        AccountEntry,
        MadeToken,
        NewPerson,
        PersonChange,
        Credentials,
        FirstOperator,
    )
}

/// The types that the screen and the module in the browser exchange, as TypeScript.
fn module() -> String {
    declarations!(
        MakeRequest,
        MakeQuality,
        MakeAnswer,
        MadePixel,
        MadeReadability,
        MakeRemark,
        BeatsAnswer,
        FilmAnswer,
        FilmPicture,
        FitAnswer,
        MakeChoices,
        MakeFont,
        MakeShape,
        MakeFile,
        MovedAnswer,
        MovedPixel,
    )
}

/// The columns of the binary message, and the statuses that its numbers stand for, as TypeScript.
fn robots() -> String {
    let mut text = String::new();
    text.push_str("\n/** The lists of `Robots` in the order of the binary message. */\n");
    text.push_str(&format!("export const ROBOT_COLUMNS = {} as const;\n", Robots::typescript_columns()));
    text.push_str("\n/** Every status, at the index that `Robots.status` holds. */\n");
    let names: Vec<String> =
        RobotStatus::ALL.iter().map(|status| snake_case(&format!("{status:?}"))).collect();
    text.push_str(&format!(
        "export const ROBOT_STATUSES: readonly RobotStatus[] = [{}];\n",
        names.join(", ")
    ));
    text
}

/// The table of formats for menus and file dialogs of the screen, as TypeScript.
fn formats() -> String {
    let rows: Vec<String> = FORMATS.iter().map(|format| format!("  {},\n", row(format))).collect();
    format!(
        "\n/** Every format of show files; the first is our own. A written file gets the first of `endings`. */\n\
         export const FORMATS = [\n{}] as const;\n\
         \n/** Name of a format, as in `/api/convert?to=`. */\n\
         export type FormatName = (typeof FORMATS)[number]['name'];\n\
         \n/** Longest file that the server reads, bytes. */\n\
         export const FILE_BYTES_MAX = {MAX_BYTES};\n",
        rows.concat()
    )
}

fn row(format: &Format) -> String {
    let list = |words: Vec<&str>| format!("{words:?}");
    format!(
        "{{ name: {:?}, program: {:?}, endings: {}, mediaType: {:?}, carries: {} }}",
        format.name,
        format.program,
        list(format.endings.to_vec()),
        format.media_type,
        list(format.carries.iter().map(|part| Part::name(*part)).collect())
    )
}

fn snake_case(variant: &str) -> String {
    format!("\"{}\"", variant.to_lowercase())
}
