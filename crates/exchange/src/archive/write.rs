//! From a show to an archive.

use lightbots_plan::ShowPlan;
use lightbots_show::{Issue, Show, excerpt};

use super::{ASSETS, DOCUMENT};
use crate::format::Written;
use crate::lightbots;
use crate::limits::MAX_BYTES;
use crate::zip_files::pack;

pub(crate) fn encode(show: &Show, plan: Option<&ShowPlan>) -> Written {
    let Written { bytes: document, mut issues } = lightbots::encode(show, plan);
    for asset in show.assets.values().filter(|asset| asset.content.is_none()) {
        let what = format!(
            "the file \"{}\" is not at hand, so the archive lacks it; add it again",
            excerpt(&asset.name)
        );
        issues.push(Issue::warning("missing-file", what));
    }
    let contents = show.assets.values().filter_map(|asset| asset.content.as_ref());
    let sum = contents.map(|content| content.len()).sum::<usize>() + document.len();
    if sum > MAX_BYTES {
        let what = format!(
            "the show and its files have more than {} MiB and cannot be read again; take some away",
            MAX_BYTES >> 20
        );
        issues.push(Issue::error("too-big", what));
    }
    let assets = show.assets.iter().filter_map(|(hash, asset)| Some((hash, asset.content.as_deref()?)));
    let assets = assets.map(|(hash, content)| (format!("{ASSETS}{hash}"), content));
    let bytes =
        pack([(DOCUMENT.to_owned(), &document[..])].into_iter().chain(assets)).unwrap_or_else(|issue| {
            issues.push(issue);
            Vec::new()
        });
    Written { bytes, issues }
}
