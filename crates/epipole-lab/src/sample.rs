//! Precomputes the slow results of the sample that the Lab opens with, so that it opens solved:
//! `epipole-lab-sample FILE` writes the file that the page loads. A program rather than an example,
//! as an example would also compile the dependencies of tests.

use epipole_lab::project::{Project, Sample};
use epipole_lab::session::Event;
use epipole_lab::tasks::{ReconstructionOfAll, compute};
use std::ops::ControlFlow;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args().nth(1).ok_or("epipole-lab-sample FILE")?;
    let mut project = Project::default();
    project.update(Event::OpenSample(Sample::Table));
    while let Some(pending) = project.pending().first().copied() {
        let request = pending
            .request(&project)
            .ok_or("an input of a missing output is missing")?;
        let result = compute(&request.to_bytes(), &mut |_| ControlFlow::Continue(()));
        project.done(&pending, result);
    }
    if project.get(ReconstructionOfAll).is_none() {
        return Err("the sample is not reconstructed".into());
    }
    std::fs::write(path, project.light_computed().to_bytes())?;
    Ok(())
}
