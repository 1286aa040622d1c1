//! The page: heat map, sentences, and every cell with its worst example. Nothing is fetched from elsewhere.

use std::fmt::{self, Write};

use nbrdf_core::stress::{Group, Hazard, Verdict};

use super::saved::Saved;
use super::sentences::{cells, sentence};
use crate::measure::stress::Cell;
use crate::report::figure;
use crate::report::svg::escaped;

/// The whole file.
pub(super) fn html(saved: &Saved, map: &str) -> String {
    let mut out = String::new();
    // Writing to a string cannot fail.
    let _ = write(&mut out, saved, map);
    out
}

fn write(out: &mut String, saved: &Saved, map: &str) -> fmt::Result {
    let count = |verdict| saved.count(verdict);
    writeln!(
        out,
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" \
         content=\"width=device-width\">\n<title>Where methods fail</title>\n<style>{STYLE}</style>\n</head>\n<body>\n\
         <h1>Where methods fail</h1>\n<p>{} hazards; {} cells hold, {} degrade, {} refuse with an error, {} fail. \
         Measured on {} held-out MERL materials ({} reference), seed {}, ZNBRDF checkpoint {}. A method's value is that of \
         its worst example, which is pictured: what should be, what is, and FLIP of the difference (white is 0.3); or the \
         ends of a walk and what is between.</p>\n<div class=\"map\">{map}</div>",
        saved.hazards().len(),
        count(Verdict::Holds),
        count(Verdict::Degrades),
        count(Verdict::Refuses),
        count(Verdict::Fails),
        saved.counted.materials,
        escaped(&saved.reference),
        saved.seed,
        escaped(&saved.checkpoint)
    )?;
    for group in Group::ALL {
        let hazards: Vec<&Hazard> = saved.hazards().into_iter().filter(|hazard| hazard.group == group).collect();
        if !hazards.is_empty() {
            writeln!(out, "<h2>{}</h2>", group.name())?;
        }
        hazards.into_iter().try_for_each(|hazard| section(out, saved, hazard))?;
    }
    writeln!(out, "</body>\n</html>")
}

fn section(out: &mut String, saved: &Saved, hazard: &Hazard) -> fmt::Result {
    writeln!(
        out,
        "<section id=\"{name}\">\n<h3>{} <code>{name}</code></h3>\n<p>{}</p>\n<p class=\"quiet\">{}; holds up to {}, fails \
         above {}</p>",
        escaped(hazard.title),
        escaped(&sentence(saved, hazard)),
        escaped(hazard.measure),
        hazard.holds,
        hazard.fails,
        name = hazard.name,
    )?;
    writeln!(
        out,
        "<details{}><summary>all methods</summary>\n<table>\n<tr><th>method<th>verdict<th class=\"n\">value<th \
         class=\"n\">share that does not hold<th>worst examples<th>what the software says<th>the worst</tr>",
        if cells(saved, hazard).iter().any(|cell| cell.verdict == Verdict::Fails) { " open" } else { "" }
    )?;
    cells(saved, hazard).into_iter().try_for_each(|cell| row(out, cell))?;
    writeln!(out, "</table></details>\n</section>")
}

fn row(out: &mut String, cell: &Cell) -> fmt::Result {
    let value = match (cell.value, cell.verdict) {
        (Some(value), _) => figure(value),
        (None, Verdict::Refuses) => "–".to_owned(),
        (None, _) => "not a number".to_owned(),
    };
    let warnings = cell.warnings.iter().map(|kind| kind.replace('_', " "));
    let said: Vec<String> = warnings.chain(cell.note.clone()).collect();
    let picture = cell.picture.as_ref().filter(|picture| is_base64(picture));
    let picture =
        picture.map_or(String::new(), |picture| format!("<img alt=\"\" src=\"data:image/png;base64,{picture}\">"));
    writeln!(
        out,
        "<tr><td>{}<td><span class=\"{}\">{}</span><td class=\"n\">{value}<td class=\"n\">{:.0} % of {}<td>{}<td>{}<td>{picture}</tr>",
        escaped(&cell.title()),
        cell.verdict.name(),
        cell.verdict.name(),
        100.0 * cell.share,
        cell.count,
        escaped(&cell.worst.join("; ")),
        escaped(&said.join("; ")),
    )
}

/// A report may come from a file: nothing but a picture gets into the page.
fn is_base64(text: &str) -> bool {
    text.bytes().all(|byte| byte.is_ascii_alphanumeric() || matches!(byte, b'+' | b'/' | b'='))
}

const STYLE: &str = "\
:root{color-scheme:light dark;--page:#fff;--text:#222;--quiet:#666;--line:#ddd}\
@media(prefers-color-scheme:dark){:root{--page:#16181c;--text:#e6e6e6;--quiet:#aaa;--line:#34373d}}\
body{font:15px/1.45 system-ui,sans-serif;background:var(--page);color:var(--text);max-width:1120px;margin:24px auto;padding:0 20px}\
h1{font-size:26px;margin:0 0 8px}h2{margin:36px 0 4px;text-transform:capitalize}h3{margin:24px 0 2px;font-size:17px}\
p{margin:4px 0}code{font-size:13px;color:var(--quiet);font-weight:400}.quiet{color:var(--quiet);font-size:13px}\
.map{overflow-x:auto;margin:16px 0}summary{cursor:pointer;color:var(--quiet);margin:6px 0}\
table{border-collapse:collapse;font-size:13px;width:100%}td,th{padding:4px 8px;text-align:left;border-bottom:1px solid var(--line);vertical-align:middle}\
.n{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}img{display:block;border-radius:3px}\
span{padding:1px 7px;border-radius:9px;color:#111;white-space:nowrap}.holds{background:#cfe8de}.refuses{background:#b9cfe6}\
.degrades{background:#f3c969}.fails{background:#d55e00;color:#fff}";
