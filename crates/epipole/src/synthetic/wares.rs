//! Things to put on a table, and the textures that they share.

use super::body::{Body, Paint};
use super::light::Proxy;
use super::noise::{NOISE, Noise};
use super::paint;
use super::shape::{Cuboid, FRONT, Lathe, Profile, RIGHT, Ring, Shape, TOP};
use super::texture::Texture;
use nalgebra::Vector3;
use std::sync::{Arc, OnceLock};

const MUG_RADIUS_M: f64 = 0.048;
/// A mug of scale 1.
pub(super) const MUG_HEIGHT_M: f64 = 0.118;
const MUG_COFFEE_M: f64 = 0.088;
const JUG_HEIGHT_M: f64 = 0.34;

/// One book of the collection.
pub(super) struct Edition {
    spine: Arc<Texture>,
    cover: Option<Arc<Texture>>,
    cloth: [f32; 3],
}

/// Textures that both scenes use, painted once.
pub(super) struct Wares {
    pub(super) noise: &'static Noise,
    pub(super) plaster: Arc<Texture>,
    pub(super) floor: Arc<Texture>,
    window: Arc<Texture>,
    pub(super) landscape: Arc<Texture>,
    pub(super) geometric: Arc<Texture>,
    pub(super) star_chart: Arc<Texture>,
    pub(super) editions: Vec<Edition>,
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
pub(super) const LANDSCAPE_M: [f64; 2] = [0.62, 0.46];
pub(super) const GEOMETRIC_M: [f64; 2] = [0.38, 0.46];
pub(super) const STAR_CHART_M: [f64; 2] = [0.40, 0.52];
/// How far a picture stands out from its wall, meters.
pub(super) const PICTURE_DEPTH_M: f64 = 0.028;
/// Side of the square of wall that the plaster covers before it repeats, meters.
pub(super) const PLASTER_M: f64 = 1.7;

impl Wares {
    pub(super) fn shared() -> &'static Self {
        static WARES: OnceLock<Wares> = OnceLock::new();
        WARES.get_or_init(Self::paint)
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

    /// A book lying flat, its spine toward −z, `center` in the middle of its lower face.
    pub(super) fn book(
        &self,
        index: usize,
        center: [f64; 3],
        size_m: [f64; 3],
        yaw_rad: f64,
    ) -> Vec<Body> {
        let name = "a book";
        let edition = &self.editions[index % self.editions.len()];
        let [length, thick, deep] = size_m;
        let board = 0.0030;
        let cloth = Paint::new(&self.linen)
            .tinted(edition.cloth.map(|channel| channel * 1.7))
            .glossy(0.5)
            .lit(12, 12);
        let edge = cloth.clone().repeated(2.0, 0.05).lit(16, 1);
        let leaves = Paint::new(&self.pages).repeated(3.0, 1.0).lit(16, 8);
        let at = |x: f64, y: f64, z: f64| placed(center, yaw_rad, [x, y, z]);
        let cuboid = |size: [f64; 3], middle: [f64; 3], paint: &Paint| {
            Body::new(
                name,
                Shape::Cuboid(Cuboid::solid(size[0], size[1], size[2])),
                middle,
                paint,
            )
            .turned(yaw_rad)
        };
        let top_paint = match &edition.cover {
            Some(cover) => Paint::new(cover).glossy(0.6).lit(24, 18),
            None => cloth.clone().repeated(2.0, 1.5).lit(24, 18),
        };
        let mut parts = vec![
            cuboid([length, board, deep], at(0.0, -board / 2.0, 0.0), &edge),
            cuboid(
                [length, board, deep],
                at(0.0, board / 2.0 - thick, 0.0),
                &edge,
            )
            .painted(TOP, &top_paint),
            cuboid(
                [length - 0.010, thick - 2.0 * board, deep - 0.010],
                at(0.0, -thick / 2.0, 0.0),
                &leaves,
            ),
            cuboid(
                [length, thick, 0.004],
                at(0.0, -thick / 2.0, -deep / 2.0 - 0.002),
                &edge,
            )
            .painted(FRONT, &Paint::new(&edition.spine).glossy(0.8).lit(24, 6)),
        ];
        // One stand-in for all four.
        let whole = cuboid(size_m, at(0.0, -thick / 2.0, 0.0), &edge).boxed();
        parts[2].proxies = whole.proxies;
        parts
    }

    /// A mug of coffee, its foot at `foot`, the handle along local x.
    pub(super) fn mug(&self, foot: [f64; 3], yaw_rad: f64, scale: f64) -> Vec<Body> {
        let name = "the mug";
        let (radius, height) = (MUG_RADIUS_M * scale, MUG_HEIGHT_M * scale);
        let glaze = Paint::new(&self.mug).glossy(1.0).lit(44, 30);
        let cup = Body::new(
            name,
            Shape::Lathe(Lathe::new(mug_profile().scaled(scale))),
            foot,
            &glaze,
        )
        .turned(yaw_rad)
        .standing_for(&[Proxy::Post {
            center: Vector3::new(0.0, -height / 2.0, 0.0),
            radius,
            half_height: height / 2.0,
        }])
        .hollow();
        let offset = radius - 0.004 * scale;
        let handle = Paint::new(&self.plain)
            .tinted([0.030, 0.075, 0.27])
            .glossy(1.0)
            .lit(32, 10);
        let ring = Ring::new(
            0.0285 * scale,
            0.0062 * scale,
            1.25,
            1.25,
            radius - 0.003 * scale - offset,
        );
        let handle = Body::new(
            name,
            Shape::Ring(ring),
            placed(foot, yaw_rad, [offset, -0.53 * height, 0.0]),
            &handle,
        )
        .turned(yaw_rad)
        .hollow();
        vec![cup, handle]
    }

    /// A tall jug.
    pub(super) fn jug(&self, foot: [f64; 3], yaw_rad: f64, scale: f64) -> Body {
        let post = |low: f64, high: f64, radius: f64| Proxy::Post {
            center: Vector3::new(0.0, -(low + high) / 2.0 * scale, 0.0),
            radius: radius * scale,
            half_height: (high - low) / 2.0 * scale,
        };
        Body::new(
            "the jug",
            Shape::Lathe(Lathe::new(jug_profile().scaled(scale))),
            foot,
            &Paint::new(&self.jug).glossy(1.0).lit(32, 44),
        )
        .turned(yaw_rad)
        .standing_for(&[
            post(0.0, 0.03, 0.062),
            post(0.03, 0.20, 0.092),
            post(0.20, 0.34, 0.045),
        ])
        .hollow()
    }

    /// An orange that rests on `foot`.
    pub(super) fn orange(&self, foot: [f64; 3], radius_m: f64, turn: [f64; 2]) -> Body {
        let shape = ball_profile(radius_m, radius_m * 0.95, 0.0);
        self.fruit(
            "an orange",
            shape,
            &self.orange,
            foot,
            radius_m * 0.97,
            turn,
        )
    }

    /// A ball, `foot` where it touches the table.
    pub(super) fn ball(&self, foot: [f64; 3], radius_m: f64) -> Body {
        let shape = ball_profile(radius_m, radius_m, 0.0);
        let mut body = self.fruit("the ball", shape, &self.orange, foot, radius_m, [0.4, 0.5]);
        body.paints[0].light_cells = [48, 32];
        body
    }

    /// A lemon that lies on `foot`.
    pub(super) fn lemon(&self, foot: [f64; 3], turn: [f64; 2]) -> Body {
        let shape = ball_profile(0.030, 0.041, 0.007);
        self.fruit("a lemon", shape, &self.lemon, foot, 0.0305, turn)
    }

    fn fruit(
        &self,
        name: &'static str,
        profile: Profile,
        texture: &Arc<Texture>,
        foot: [f64; 3],
        rest_m: f64,
        turn: [f64; 2],
    ) -> Body {
        Body::new(
            name,
            Shape::Lathe(Lathe::new(profile)),
            [foot[0], foot[1] - rest_m, foot[2]],
            &Paint::new(texture).glossy(0.55).lit(24, 18),
        )
        .rotated(turn[0], turn[1])
        .standing_for(&[Proxy::Ball {
            center: Vector3::zeros(),
            radius: rest_m,
        }])
    }

    /// An apple with its stalk, its foot at `foot`.
    pub(super) fn apple(&self, foot: [f64; 3], radius_m: f64, yaw_rad: f64) -> Vec<Body> {
        let name = "the apple";
        let mut profile = Profile::from_height(0.0);
        let num = 26;
        let mut lowest = f64::INFINITY;
        let curve: Vec<(f64, f64)> = (0..=num)
            .map(|i| {
                let angle = std::f64::consts::PI * f64::from(i) / f64::from(num);
                let (sin, cos) = libm::sincos(angle);
                let dimple = |width: f64, from: f64| {
                    let x = from / width;
                    libm::exp(-x * x)
                };
                // From the flower's end below to the stalk's above.
                let reach = 1.0 + 0.05 * cos.abs()
                    - 0.22 * dimple(0.30, angle)
                    - 0.50 * dimple(0.34, std::f64::consts::PI - angle)
                    - 0.10 * (1.0 - angle / std::f64::consts::PI) * (0.3 - cos).abs() * 0.5;
                lowest = lowest.min(-reach * cos * radius_m);
                (reach * sin * radius_m, -reach * cos * radius_m)
            })
            .collect();
        for (i, (radius, height)) in curve.iter().enumerate() {
            let height = height - lowest;
            profile = if i == 0 {
                Profile::from_height(height)
            } else {
                profile.to(if i == curve.len() - 1 { 0.0 } else { *radius }, height)
            };
        }
        let top_m = curve[curve.len() - 1].1 - lowest;
        let flesh = Body::new(
            name,
            Shape::Lathe(Lathe::new(profile)),
            foot,
            &Paint::new(&self.apple).glossy(0.9).lit(28, 20),
        )
        .turned(yaw_rad)
        .standing_for(&[Proxy::Ball {
            center: Vector3::new(0.0, -radius_m, 0.0),
            radius: radius_m * 0.95,
        }])
        .hollow();
        let stalk = Body::new(
            name,
            Shape::Lathe(Lathe::new(
                Profile::new()
                    .to(0.0014, 0.0)
                    .to(0.0011, 0.016)
                    .to(0.0019, 0.024)
                    .sharp()
                    .to(0.0, 0.024),
            )),
            [foot[0], foot[1] - top_m + 0.001, foot[2]],
            &Paint::new(&self.plain).tinted([0.10, 0.055, 0.025]),
        )
        .rotated(yaw_rad, 0.25);
        vec![flesh, stalk]
    }

    /// A tea tin, `foot` in the middle of its lower face.
    pub(super) fn tin(&self, foot: [f64; 3], size_m: [f64; 3], yaw_rad: f64) -> Vec<Body> {
        let name = "the tea tin";
        let side = Paint::new(&self.tin).glossy(0.9).lit(16, 24);
        let lid = Paint::new(&self.linen)
            .tinted([0.30, 0.05, 0.055])
            .glossy(1.2)
            .lit(16, 16);
        let lid_m = 0.012;
        vec![
            Body::new(
                name,
                Shape::Cuboid(Cuboid::solid(size_m[0], size_m[1], size_m[2])),
                placed(foot, yaw_rad, [0.0, -size_m[1] / 2.0, 0.0]),
                &side,
            )
            .turned(yaw_rad)
            .boxed(),
            Body::new(
                name,
                Shape::Cuboid(Cuboid::solid(size_m[0] * 1.03, lid_m, size_m[2] * 1.03)),
                placed(foot, yaw_rad, [0.0, -size_m[1] - lid_m / 2.0, 0.0]),
                &lid,
            )
            .turned(yaw_rad)
            .boxed(),
        ]
    }

    /// A window in a wall whose inside faces +x, `middle` on that wall.
    pub(super) fn window(&self, middle: [f64; 3], size_m: [f64; 2]) -> Body {
        let deep = 0.03;
        Body::new(
            "the window",
            Shape::Cuboid(Cuboid::solid(deep, size_m[1], size_m[0])),
            [middle[0] + deep / 2.0, middle[1], middle[2]],
            &Paint::new(&self.floor).tinted([1.6; 3]),
        )
        .painted(RIGHT, &Paint::new(&self.window).glowing(1.25))
    }

    /// A framed picture that hangs on a wall, its painted face toward local −z.
    pub(super) fn picture(
        &self,
        texture: &Arc<Texture>,
        size_m: [f64; 2],
        middle: [f64; 3],
        yaw_rad: f64,
    ) -> Body {
        let side = Paint::new(&self.linen).tinted([0.12, 0.07, 0.04]);
        Body::new(
            "a picture",
            Shape::Cuboid(Cuboid::solid(size_m[0], size_m[1], PICTURE_DEPTH_M)),
            middle,
            &side,
        )
        .turned(yaw_rad)
        .painted(FRONT, &Paint::new(texture).glossy(0.25).lit(16, 16))
        .boxed()
    }
}

/// The place of a part, given in the frame of a thing that stands at `at`, turned by `yaw_rad`.
pub(super) fn placed(at: [f64; 3], yaw_rad: f64, part: [f64; 3]) -> [f64; 3] {
    let (sin, cos) = libm::sincos(yaw_rad);
    [
        at[0] + cos * part[0] - sin * part[2],
        at[1] + part[1],
        at[2] + sin * part[0] + cos * part[2],
    ]
}

fn mug_profile() -> Profile {
    let (r, h, wall) = (MUG_RADIUS_M, MUG_HEIGHT_M, 0.0048);
    Profile::new()
        .to(0.80 * r, 0.0)
        .sharp()
        .to(0.86 * r, 0.003)
        .to(0.93 * r, 0.008)
        .to(0.975 * r, 0.016)
        .to(r, 0.030)
        .to(r, h - 0.004)
        .to(r - 0.0006, h - 0.0012)
        .to(r - 0.0018, h)
        .to(r - 0.0034, h - 0.0004)
        .to(r - wall, h - 0.003)
        .to(r - wall, MUG_COFFEE_M)
        .sharp()
        .to(0.0, MUG_COFFEE_M)
        .sharp()
}

fn jug_profile() -> Profile {
    let outer = [
        (0.058, 0.004),
        (0.064, 0.012),
        (0.077, 0.035),
        (0.088, 0.065),
        (0.0945, 0.100),
        (0.0955, 0.130),
        (0.0915, 0.160),
        (0.082, 0.190),
        (0.068, 0.217),
        (0.054, 0.240),
        (0.045, 0.261),
        (0.0415, 0.282),
        (0.0425, 0.303),
        (0.048, 0.322),
        (0.056, 0.336),
        (0.0575, 0.340),
    ];
    let mut profile = Profile::new().to(0.055, 0.0).sharp();
    for (radius, height) in outer {
        profile = profile.to(radius, height);
    }
    for (radius, height) in [
        (0.0545, 0.3395),
        (0.0445, 0.321),
        (0.0375, 0.300),
        (0.0370, 0.282),
        (0.041, 0.262),
    ] {
        profile = profile.to(radius, height);
    }
    profile.sharp().to(0.0, 0.262).sharp()
}

/// A ball stretched to `half_m` along its axis, with tips.
fn ball_profile(radius_m: f64, half_m: f64, tip_m: f64) -> Profile {
    let num = 24;
    let point = |i: i32| {
        let (sin, cos) = libm::sincos(std::f64::consts::PI * f64::from(i) / f64::from(num));
        let tip = cos * cos * cos * cos * cos * cos * cos;
        (radius_m * sin, -half_m * cos - tip_m * tip)
    };
    let mut profile = Profile::from_height(point(0).1);
    for i in 1..num {
        let (radius, height) = point(i);
        profile = profile.to(radius, height);
    }
    profile.to(0.0, point(num).1)
}
