//! The doctor: it must find nothing wrong with the robots in the box, and name each of many planted faults.

use doctor::{Finding, Remedy};
use halfstep_tests::planted_faults::{PLANTED, examined, first_wrong};

use crate::cores::on_all_cores;
use crate::table;

#[derive(clap::Args)]
pub(crate) struct Options {
    /// Only faults and robots whose name contains this
    #[arg(long, default_value = "")]
    only: String,
}

pub(crate) fn survey(options: &Options) -> bool {
    robots(options) & faults(options)
}

fn robots(options: &Options) -> bool {
    let names = ["g1", "gr1t1", "h1_2", "jvrc1", "limx", "op3", "qinglong", "t1", "talos"];
    let robots = names.map(|name| (name, format!("config/robots/{name}")));
    let robots = std::iter::once(("paper", "config".to_owned())).chain(robots);
    let robots: Vec<(&str, String)> = robots.filter(|(name, _)| name.contains(&options.only)).collect();
    let found = on_all_cores(robots.len(), |index| first_wrong(&examined(&robots[index].1)));
    let rows: Vec<Vec<String>> = std::iter::zip(&robots, &found)
        .map(|((name, _), wrong)| vec![(*name).to_owned(), wrong.as_ref().map_or("healthy".into(), text)])
        .collect();
    table::print(&["robot", "found"], &rows);
    found.iter().all(Option::is_none)
}

fn faults(options: &Options) -> bool {
    let faults: Vec<_> = PLANTED.iter().filter(|fault| fault.name.contains(&options.only)).collect();
    let found = on_all_cores(faults.len(), |index| faults[index].found());
    let rows: Vec<Vec<String>> = std::iter::zip(&faults, &found)
        .map(|(fault, wrong)| {
            let verdict = if fault.is_named_by(wrong.as_ref()) { "named" } else { "NOT NAMED" };
            vec![fault.name.to_owned(), verdict.to_owned(), wrong.as_ref().map_or("nothing".into(), text)]
        })
        .collect();
    table::print(&["planted", "", "found"], &rows);
    std::iter::zip(&faults, &found).all(|(fault, wrong)| fault.is_named_by(wrong.as_ref()))
}

fn text(finding: &Finding) -> String {
    let keys: Vec<String> = finding.remedies.iter().map(Remedy::place).collect();
    format!("{}: {} -> {}", finding.check, finding.wrong.as_deref().unwrap_or_default(), keys.join(", "))
}
