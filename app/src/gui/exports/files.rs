//! What is known of files that are written, and how they are named.

use std::path::PathBuf;

use crate::worker::export::News;

/// What the worker said of files.
#[derive(Debug, Default)]
pub struct Files {
    /// The files last asked about, and those of them that are there.
    pub there: Option<[Vec<PathBuf>; 2]>,
    /// How much of what is being written is done, 0..1; none where nothing is.
    pub progress: Option<f32>,
    /// How many exports have ended, well or not.
    pub ended: u64,
}

impl Files {
    /// Takes an answer in; what the user is to be told of it.
    pub fn take(&mut self, news: News) -> Option<String> {
        match news {
            News::Present { asked, there } => {
                self.there = Some([asked, there]);
                None
            }
            News::Progress(share) => {
                self.progress = Some(share);
                None
            }
            News::Written { files, warning } => {
                self.end();
                let told = written(&files);
                Some(match warning {
                    Some(warning) => format!("{told} But {warning}."),
                    None => told,
                })
            }
            News::Failed(why) => {
                self.end();
                Some(why)
            }
            // Of a code nothing is written: what is being written goes on.
            News::NoCode(why) => Some(why),
            News::Code(_) => Some("The code of this point is on the clipboard.".to_owned()),
        }
    }

    fn end(&mut self) {
        self.progress = None;
        self.there = None;
        self.ended += 1;
    }
}

/// Names a few files in a sentence.
fn written(files: &[PathBuf]) -> String {
    let folder = files.first().and_then(|file| file.parent()).unwrap_or(std::path::Path::new("")).display();
    format!("Written to {folder}: {}", listed(files))
}

/// The names of the first few.
pub fn listed(files: &[PathBuf]) -> String {
    const MOST: usize = 4;
    let name = |file: &PathBuf| file.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let mut names: Vec<String> = files.iter().take(MOST).map(name).collect();
    if files.len() > MOST {
        names.push(format!("and {} more", files.len() - MOST));
    }
    names.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_code_that_fails_leaves_what_is_being_written_alone() {
        let mut files = Files { progress: Some(0.5), ..Files::default() };
        assert_eq!(files.take(News::NoCode("none".to_owned())), Some("none".to_owned()));
        assert_eq!((files.progress, files.ended), (Some(0.5), 0));
        assert_eq!(files.take(News::Failed("full".to_owned())), Some("full".to_owned()));
        assert_eq!((files.progress, files.ended), (None, 1));
    }
}
