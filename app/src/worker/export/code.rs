//! Codes of points.

use anyhow::{Context as _, Error, Result, anyhow};
use autoencoder::{Architecture, Autoencoder};
use nbrdf_core::Code;

use super::Exporter;
use crate::catalog::exporters::json;
use crate::worker::paths::Prepared;
use crate::worker::{Card, Request, guarded};

/// The plain method through codes of ZNBRDF; the names of all others begin with it.
const LATENT: &str = "latent";

/// A code with its name, and how far it is from what is known.
pub(super) fn told(code: Code, name: &str) -> Result<Code> {
    let distance = Autoencoder::built_in(Architecture::Znbrdf).distance(&code)?;
    Ok(Code { material: Some(name.to_owned()), distance, ..code })
}

impl Exporter {
    /// The code of the point that is shown, by the first method that walks through codes of ZNBRDF: paths that are there
    /// come first, and none is prepared that has other codes. A method that fails leaves it to the next.
    pub(super) fn code(&self, shown: &Request) -> Result<String> {
        let is_ready =
            |method: &&'static str| matches!(self.office.paths.get(&shown.key(method)), Some(Prepared::Ready(_)));
        let (ready, others): (Vec<_>, Vec<_>) = shown.methods.iter().copied().partition(is_ready);
        let others = others.into_iter().filter(|method| method.starts_with(LATENT));
        let mut failure = None;
        for method in ready.into_iter().chain(others).chain([LATENT]) {
            let found = guarded("The code", || self.code_of(method, shown));
            match found.map_err(Error::msg).flatten() {
                Ok(Some(code)) => return Ok(code),
                Ok(None) => {}
                Err(error) => failure = failure.or(Some(error)),
            }
        }
        Err(failure.unwrap_or_else(|| anyhow!("no method shown walks through codes: show Latent")))
    }

    /// The code of the point of a method; none where it walks through other codes, which are longer, or no networks, or
    /// through none.
    fn code_of(&self, method: &'static str, shown: &Request) -> Result<Option<String>> {
        let path = self.path(method, shown)?;
        if path.code(&shown.weights)?.is_none_or(|code| code.model != Architecture::Znbrdf.name()) {
            return Ok(None);
        }
        let code = self.shown(shown, Card::Method(method))?.code;
        code.as_ref().and_then(json).map(Some).context("the code cannot be written")
    }
}
