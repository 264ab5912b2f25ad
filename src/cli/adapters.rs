//! `motes adapters`: what scenes can run on.

use super::{CliError, print};
use crate::gpu::AdapterDescription;
pub(crate) use crate::json::quoted;

/// Arguments of `motes adapters`.
#[derive(Debug, clap::Args)]
pub(super) struct AdaptersArgs {
    /// Print JSON
    #[arg(long)]
    json: bool,
}

pub(super) fn run(args: &AdaptersArgs) -> Result<u8, CliError> {
    let mut adapters = crate::gpu::adapters();
    adapters.push(AdapterDescription {
        name: "cpu".into(),
        driver: format!("motes {} with rayon", env!("CARGO_PKG_VERSION")),
        backend: "cpu".into(),
        kind: "processor",
        exact: true,
        most_binding_bytes: u64::MAX,
    });
    print(&if args.json {
        json(&adapters)
    } else {
        table(&adapters)
    })?;
    Ok(0)
}

fn table(adapters: &[AdapterDescription]) -> String {
    let mut text = String::new();
    for (at, adapter) in adapters.iter().enumerate() {
        let mark = if at == 0 { "*" } else { " " };
        let exact = if adapter.exact { "yes" } else { "no" };
        text += &format!(
            "{mark} {}\n    {}, {}, {}\n    exact: {exact}\n",
            adapter.name, adapter.kind, adapter.backend, adapter.driver
        );
    }
    text + "* is what `--adapter auto` takes; name another by part of its name or driver\n"
}

fn json(adapters: &[AdapterDescription]) -> String {
    let lines: Vec<String> = adapters
        .iter()
        .map(|adapter| {
            let AdapterDescription { name, driver, backend, kind, exact, .. } = adapter;
            format!(
                "  {{\"name\": {}, \"driver\": {}, \"backend\": {}, \"kind\": {}, \"exact\": {exact}}}",
                quoted(name),
                quoted(driver),
                quoted(backend),
                quoted(kind)
            )
        })
        .collect();
    format!("[\n{}\n]\n", lines.join(",\n"))
}
