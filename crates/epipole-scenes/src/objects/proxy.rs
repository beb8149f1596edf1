//! Simplified bodies for the shade near contacts.

use epipole::math::length;
use nalgebra::{Matrix3, Vector3};

/// A simplified body whose distance is cheap to compute, for the shade near contacts.
#[derive(Debug, Clone)]
pub(crate) enum Proxy {
    Box {
        center: Vector3<f64>,
        local_from_world: Matrix3<f64>,
        half: Vector3<f64>,
    },
    Ball {
        center: Vector3<f64>,
        radius: f64,
    },
    /// An upright cylinder around `center`.
    Post {
        center: Vector3<f64>,
        radius: f64,
        half_height: f64,
    },
    Room {
        center: Vector3<f64>,
        half: Vector3<f64>,
    },
}

impl Proxy {
    pub(crate) fn moved(&self, by: &Vector3<f64>) -> Self {
        let mut moved = self.clone();
        match &mut moved {
            Self::Box { center, .. }
            | Self::Ball { center, .. }
            | Self::Post { center, .. }
            | Self::Room { center, .. } => *center += by,
        }
        moved
    }

    pub(crate) fn distance(&self, p: &Vector3<f64>) -> f64 {
        match self {
            Self::Box {
                center,
                local_from_world,
                half,
            } => {
                let q = (local_from_world * (p - center)).abs() - half;
                let outside = length(&q.map(|x| x.max(0.0)));
                outside + q.max().min(0.0)
            }
            Self::Ball { center, radius } => length(&(p - center)) - radius,
            Self::Post {
                center,
                radius,
                half_height,
            } => {
                let d = p - center;
                let side = (d.x * d.x + d.z * d.z).sqrt() - radius;
                let end = d.y.abs() - half_height;
                let (a, b) = (side.max(0.0), end.max(0.0));
                (a * a + b * b).sqrt() + side.max(end).min(0.0)
            }
            Self::Room { center, half } => (half - (p - center).abs()).min(),
        }
    }
}
