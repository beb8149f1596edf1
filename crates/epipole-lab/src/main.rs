//! The Lab in a window: `cargo run -p epipole-lab --features window [PHOTOGRAPHS…]`.

mod native;

fn main() -> eframe::Result {
    native::give_back();
    native::run(std::env::args_os().skip(1).map(Into::into).collect())
}
