//! Objects on tables and walls, and their shared textures.

mod books;
mod crockery;
mod fruit;
mod profiles;
mod tin;
mod walls;

pub(crate) use profiles::MUG_HEIGHT_M;

use crate::paint;
use crate::paint::noise::{NOISE, Noise};
use crate::paint::texture::Texture;
use crate::shape::Lathe;
use profiles::{JUG_HEIGHT_M, MUG_COFFEE_M, jug_profile, mug_profile};
use std::sync::{Arc, OnceLock};

/// One book of the collection.
pub(crate) struct Edition {
    spine: Arc<Texture>,
    cover: Option<Arc<Texture>>,
    cloth: [f32; 3],
}

/// Textures that all scenes share, painted once.
pub(crate) struct Props {
    pub(crate) noise: &'static Noise,
    pub(crate) plaster: Arc<Texture>,
    pub(crate) floor: Arc<Texture>,
    window: Arc<Texture>,
    pub(crate) landscape: Arc<Texture>,
    pub(crate) geometric: Arc<Texture>,
    pub(crate) star_chart: Arc<Texture>,
    pub(crate) editions: Vec<Edition>,
    linen: Arc<Texture>,
    pages: Arc<Texture>,
    mug: Arc<Texture>,
    jug: Arc<Texture>,
    orange: Arc<Texture>,
    lemon: Arc<Texture>,
    apple: Arc<Texture>,
    tin: Arc<Texture>,
    plain: Arc<Texture>,
}

/// Sizes of the pictures on the walls, meters.
pub(crate) const LANDSCAPE_M: [f64; 2] = [0.62, 0.46];
pub(crate) const GEOMETRIC_M: [f64; 2] = [0.38, 0.46];
pub(crate) const STAR_CHART_M: [f64; 2] = [0.40, 0.52];
/// Distance of a picture's front from its wall, meters.
pub(crate) const PICTURE_DEPTH_M: f64 = 0.028;
/// Period of the repeating plaster on walls, meters.
pub(crate) const PLASTER_M: f64 = 1.7;

impl Props {
    pub(crate) fn shared() -> &'static Self {
        static PROPS: OnceLock<Props> = OnceLock::new();
        PROPS.get_or_init(Self::paint)
    }

    fn paint() -> Self {
        let noise: &'static Noise = &NOISE;
        let edition = |cloth: [f32; 3], label: [f32; 3], title: &str, aspect: f32, cover| Edition {
            spine: Arc::new(paint::book_spine(
                noise,
                cloth,
                label,
                title,
                aspect,
                10.0 * aspect,
            )),
            cover,
            cloth,
        };
        let red = [0.34, 0.045, 0.035];
        let navy = [0.035, 0.065, 0.17];
        let ochre = [0.46, 0.27, 0.06];
        let green = [0.04, 0.14, 0.085];
        let black = [0.03, 0.028, 0.03];
        let cover = Arc::new(paint::book_cover(noise, green, "SIGHT"));
        let editions = vec![
            edition(red, black, "MULTIPLE VIEWS", 6.2, None),
            edition(ochre, navy, "LIGHT AND LENSES", 7.2, None),
            edition(green, red, "SIGHT", 7.4, Some(cover)),
            edition(navy, red, "ATLAS OF RAYS", 6.6, None),
        ];
        let mug_profile = Lathe::new(mug_profile());
        let jug_profile = Lathe::new(jug_profile());
        Self {
            plaster: Arc::new(paint::plaster(noise)),
            floor: Arc::new(paint::floor(noise)),
            window: Arc::new(paint::window(noise)),
            landscape: Arc::new(paint::landscape(noise, LANDSCAPE_M.map(|side| side as f32))),
            geometric: Arc::new(paint::geometric(noise, GEOMETRIC_M.map(|side| side as f32))),
            star_chart: Arc::new(paint::star_chart(
                noise,
                STAR_CHART_M.map(|side| side as f32),
            )),
            editions,
            linen: Arc::new(paint::linen(noise)),
            pages: Arc::new(paint::pages(noise)),
            mug: Arc::new(paint::mug(
                noise,
                move |t| mug_profile.profile_at(t),
                MUG_HEIGHT_M,
                MUG_COFFEE_M,
            )),
            jug: Arc::new(paint::jug(
                noise,
                move |t| jug_profile.profile_at(t),
                JUG_HEIGHT_M,
            )),
            orange: Arc::new(paint::citrus(
                noise,
                [0.80, 0.25, 0.012],
                [0.83, 0.36, 0.03],
            )),
            lemon: Arc::new(paint::citrus(noise, [0.80, 0.55, 0.03], [0.83, 0.66, 0.12])),
            apple: Arc::new(paint::apple(noise)),
            tin: Arc::new(paint::tin(noise, [0.16, 0.025, 0.03], "TEA")),
            plain: Arc::new(Texture::plain([1.0; 3], 1.0)),
            noise,
        }
    }
}

/// Returns the world position of a part of an object at `at` that is rotated by `yaw_rad`.
pub(crate) fn placed(at: [f64; 3], yaw_rad: f64, part: [f64; 3]) -> [f64; 3] {
    let (sin, cos) = libm::sincos(yaw_rad);
    [
        at[0] + cos * part[0] - sin * part[2],
        at[1] + part[1],
        at[2] + sin * part[0] + cos * part[2],
    ]
}
