//! `motes scenes`: what is built in.

use super::{CliError, print};
use crate::scene::{BUILTIN, load};

/// Arguments of `motes scenes`.
#[derive(Debug, clap::Args)]
pub(super) struct ScenesArgs {
    /// Print the TOML text of one scene, to start your own from
    #[arg(long, value_name = "SCENE")]
    show: Option<String>,
}

pub(super) fn run(args: &ScenesArgs) -> Result<u8, CliError> {
    if let Some(name) = &args.show {
        // Loading first gives the message about the nearest names.
        load(name)?;
        let builtin = BUILTIN
            .iter()
            .find(|scene| scene.name == name)
            .ok_or_else(|| {
                CliError::usage(
                    format!("`{name}` is not a built-in scene"),
                    "`motes scenes` lists the built-in ones",
                )
            })?;
        print(builtin.text)?;
        return Ok(0);
    }
    let mut text = String::new();
    for builtin in BUILTIN {
        let scene = load(builtin.name)?;
        let about = scene
            .description
            .split_whitespace()
            .collect::<Vec<_>>()
            .join(" ");
        text += &format!(
            "{:<12} {}\n{:<12} {about}\n{:<12} {} frames at {} a second, {}x{}, {} systems\n",
            builtin.name,
            scene.title,
            "",
            "",
            scene.frames,
            scene.frame_rate,
            scene.image.width,
            scene.image.height,
            scene.systems.len()
        );
    }
    print(&text)?;
    Ok(0)
}
