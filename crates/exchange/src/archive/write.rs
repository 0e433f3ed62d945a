//! From a show to an archive. The same show gives the same bytes: entries have no date.

use std::io::{Cursor, Write};

use lightbots_plan::ShowPlan;
use lightbots_show::{Issue, Show, excerpt};
use zip::result::ZipResult;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipWriter};

use super::{ASSETS, DOCUMENT};
use crate::format::Written;
use crate::lightbots;
use crate::limits::MAX_BYTES;

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
    let bytes = pack(show, &document).unwrap_or_else(|error| {
        issues.push(Issue::error("not-packed", format!("the archive could not be made: {error}")));
        Vec::new()
    });
    Written { bytes, issues }
}

fn pack(show: &Show, document: &[u8]) -> ZipResult<Vec<u8>> {
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Deflated)
        .last_modified_time(DateTime::default());
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    archive.start_file(DOCUMENT, options)?;
    archive.write_all(document)?;
    for (hash, asset) in &show.assets {
        if let Some(content) = &asset.content {
            archive.start_file(format!("{ASSETS}{hash}"), options)?;
            archive.write_all(content)?;
        }
    }
    Ok(archive.finish()?.into_inner())
}
