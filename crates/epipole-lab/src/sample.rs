//! Computes what takes long of the sample that the Lab opens with: `epipole-lab-sample FILE` writes
//! it, and the Lab of a page brings it, so that it opens solved. A program of its own rather than
//! an example, which would compile what only tests need.

use epipole_lab::project::{Event, Project};
use epipole_lab::tasks::{Sample, compute};
use std::ops::ControlFlow;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args().nth(1).ok_or("epipole-lab-sample FILE")?;
    let mut project = Project::default();
    project.update(Event::OpenSample(Sample::Table));
    while let Some(task) = project.wanted().first().cloned() {
        let request = project
            .request(&task)
            .ok_or("what is wanted cannot be asked")?;
        let result = compute(&request.to_bytes(), &mut |_| ControlFlow::Continue(()));
        project.done(task.key, result);
    }
    if project.reconstruction().is_none() {
        return Err("the sample is not reconstructed".into());
    }
    std::fs::write(path, project.light_computed().to_bytes())?;
    Ok(())
}
