//! The contract between figures and pages in TypeScript, `web/src/contract.ts`.

use crate::contract::{
    Aspect, Axis, ButtonRole, ChallengeStatus, Control, ControlKind, Event, FileOffer, Layout,
    Panel, PhotoSlot, Place, PlacedSymbol, Readout, ReadoutValue, Refused, Space, Value,
};
use crate::pointing::Direction;
use crate::snapshot::{PlacedHandle, Snapshot};
use std::fs;
use ts_rs::{Config, TS};

const FILE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../web/src/contract.ts");

/// Declaration of one type, with its documentation.
fn declaration<T: TS>() -> String {
    let docs = T::docs().unwrap_or_default();
    format!("\n{docs}export {}\n", T::decl(&Config::default()))
}

fn contract() -> String {
    let types = [
        declaration::<Snapshot>(),
        declaration::<Aspect>(),
        declaration::<Layout>(),
        declaration::<Panel>(),
        declaration::<Axis>(),
        declaration::<Control>(),
        declaration::<ControlKind>(),
        declaration::<ButtonRole>(),
        declaration::<Place>(),
        declaration::<PlacedHandle>(),
        declaration::<Space>(),
        declaration::<PlacedSymbol>(),
        declaration::<Readout>(),
        declaration::<ReadoutValue>(),
        declaration::<ChallengeStatus>(),
        declaration::<PhotoSlot>(),
        declaration::<FileOffer>(),
        declaration::<Event>(),
        declaration::<Value>(),
        declaration::<Direction>(),
        declaration::<Refused>(),
    ];
    format!(
        "/** Data that figures and pages exchange. Written by `make bless-contract` from \
         `epipole-widgets`. */\n{}",
        types.concat()
    )
}

#[test]
fn the_contract_of_pages_is_that_of_figures() {
    let contract = contract();
    if std::env::var_os("EPIPOLE_BLESS").is_some() {
        fs::write(FILE, contract).unwrap();
        return;
    }
    let written = fs::read_to_string(FILE).unwrap();
    assert!(
        written == contract,
        "web/src/contract.ts is stale: run `make bless-contract`"
    );
}
