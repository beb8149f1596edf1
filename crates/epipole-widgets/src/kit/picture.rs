//! Photographs: serialization for workers, and photographs of the reader.

use crate::contract::{PhotoSlot, Problem};
use epipole::imaging::{BT601_WEIGHTS, GrayImage32, rgb_to_gray_f32};
use image::RgbImage;
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};
use std::rc::Rc;

/// A photograph shared by a model, its question and its answer without copies. Serialized as width,
/// height and bytes; inconsistent sizes are an error.
#[derive(Debug, Clone)]
pub(crate) struct Picture(Rc<RgbImage>);

impl Picture {
    pub(crate) fn image(&self) -> &RgbImage {
        &self.0
    }

    /// Returns width and height, pixels.
    pub(crate) fn size(&self) -> (u32, u32) {
        self.0.dimensions()
    }
}

impl From<RgbImage> for Picture {
    fn from(image: RgbImage) -> Self {
        Self(Rc::new(image))
    }
}

impl PartialEq for Picture {
    fn eq(&self, other: &Self) -> bool {
        Rc::ptr_eq(&self.0, &other.0) || self.0 == other.0
    }
}

/// Returns the gray levels of a photograph, 0 to 255.
pub(crate) fn gray_levels(image: &RgbImage) -> GrayImage32 {
    let mut levels = rgb_to_gray_f32(image, &BT601_WEIGHTS);
    levels.pixels_mut().for_each(|pixel| pixel.0[0] *= 255.0);
    levels
}

/// Bytes serialized in one piece, ten times as fast as one by one.
struct Bytes<'a>(&'a [u8]);

impl Serialize for Bytes<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_bytes(self.0)
    }
}

impl Serialize for Picture {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let (width, height) = self.size();
        (width, height, Bytes(self.0.as_raw())).serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Picture {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let (width, height, bytes): (u32, u32, &[u8]) = Deserialize::deserialize(deserializer)?;
        let fits = u64::from(width) * u64::from(height) * 3 == bytes.len() as u64;
        let image = RgbImage::from_raw(width, height, bytes.to_vec());
        (image.filter(|_| fits && !bytes.is_empty()).map(Self::from))
            .ok_or_else(|| de::Error::custom("the bytes of a photograph do not fit its size"))
    }
}

/// Serialization of an image of floats: `#[serde(with = "picture::floats")]`.
pub(crate) mod floats {
    use super::{Deserialize, Deserializer, GrayImage32, Serialize, Serializer, de};

    pub(crate) fn serialize<S: Serializer>(
        image: &GrayImage32,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        (image.width(), image.height(), image.as_raw()).serialize(serializer)
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<GrayImage32, D::Error> {
        let (width, height, values): (u32, u32, Vec<f32>) = Deserialize::deserialize(deserializer)?;
        let fits = u64::from(width) * u64::from(height) == values.len() as u64;
        (GrayImage32::from_raw(width, height, values).filter(|_| fits))
            .ok_or_else(|| de::Error::custom("the numbers of an image do not fit its size"))
    }
}

/// Creates the slot for one photograph of the reader.
pub(crate) const fn slot(max_side_px: u32) -> PhotoSlot {
    PhotoSlot {
        id: "photo",
        label: "Your photograph",
        max_side_px,
    }
}

/// Creates the slots of two photographs of one scene.
pub(crate) const fn pair_slots(max_side_px: u32) -> [PhotoSlot; 2] {
    [
        PhotoSlot {
            id: "first",
            label: "Your photograph 1",
            max_side_px,
        },
        PhotoSlot {
            id: "second",
            label: "Your photograph 2",
            max_side_px,
        },
    ]
}

/// Photographs of the reader, one for each slot of a figure.
pub(crate) struct Own<const N: usize> {
    slots: &'static [PhotoSlot],
    min_side_px: u32,
    pictures: [Option<Picture>; N],
}

impl<const N: usize> Own<N> {
    /// Creates empty slots.
    ///
    /// * `slots`: `N` slots
    /// * `min_side_px`: smallest accepted side, pixels
    pub(crate) fn new(slots: &'static [PhotoSlot], min_side_px: u32) -> Self {
        Self {
            slots,
            min_side_px,
            pictures: [const { None }; N],
        }
    }

    /// Takes a photograph.
    ///
    /// # Errors
    /// A message if it is too small; the state is then unchanged.
    pub(crate) fn take(&mut self, slot: &str, photo: RgbImage) -> Result<(), Problem> {
        let (width, height) = photo.dimensions();
        if width.min(height) < self.min_side_px {
            return Err(Problem::BadValue {
                name: slot.to_owned(),
                value: format!("{width} × {height} pixels"),
                expected: format!(
                    "photographs of at least {} pixels on each side",
                    self.min_side_px
                ),
            });
        }
        let index = self.slots.iter().position(|known| known.id == slot);
        if let Some(place) = index.and_then(|index| self.pictures.get_mut(index)) {
            *place = Some(photo.into());
        }
        Ok(())
    }

    /// Returns one of them, if present.
    pub(crate) fn get(&self, index: usize) -> Option<&Picture> {
        self.pictures.get(index)?.as_ref()
    }

    /// Returns all, if all are present.
    pub(crate) fn all(&self) -> Option<[Picture; N]> {
        let all: Vec<Picture> = self.pictures.iter().flatten().cloned().collect();
        all.try_into().ok()
    }

    /// Names the photographs that the reader has yet to choose, as a sentence.
    pub(crate) fn wanted(&self) -> String {
        let missing = self.pictures.iter().position(Option::is_none);
        let present = self.pictures.iter().position(Option::is_some);
        match (missing, present) {
            (Some(_), None) if N == 1 => "Choose a photograph.".to_owned(),
            (Some(_), None) => {
                "Choose two photographs of one scene, taken from two places.".to_owned()
            }
            (Some(missing), Some(present)) => format!(
                "Photograph {} is there; now choose photograph {}.",
                present + 1,
                missing + 1
            ),
            (None, _) => String::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SLOTS: &[PhotoSlot] = &[
        PhotoSlot {
            id: "first",
            label: "Your first photograph",
            max_side_px: 64,
        },
        PhotoSlot {
            id: "second",
            label: "Your second photograph",
            max_side_px: 64,
        },
    ];

    #[test]
    fn a_photograph_returns_as_it_went() {
        let picture = Picture::from(RgbImage::from_fn(3, 2, |u, v| {
            image::Rgb([u as u8, v as u8, 7])
        }));
        let bytes = postcard::to_allocvec(&picture).unwrap();
        let back: Picture = postcard::from_bytes(&bytes).unwrap();
        assert_eq!(back, picture);
        assert_eq!(back.size(), (3, 2));
        let wrong = postcard::to_allocvec(&(3_u32, 3_u32, Bytes(&[0; 18]))).unwrap();
        assert!(postcard::from_bytes::<Picture>(&wrong).is_err());
        let empty = postcard::to_allocvec(&(0_u32, 0_u32, Bytes(&[]))).unwrap();
        assert!(postcard::from_bytes::<Picture>(&empty).is_err());
    }

    #[test]
    fn own_photographs_are_taken_one_by_one() {
        let mut own = Own::<2>::new(SLOTS, 16);
        assert!(own.wanted().starts_with("Choose two"));
        own.take("second", RgbImage::new(20, 30)).unwrap();
        assert_eq!(
            own.wanted(),
            "Photograph 2 is there; now choose photograph 1."
        );
        let refused = own.take("first", RgbImage::new(20, 3)).unwrap_err();
        assert!(refused.to_string().contains("20 × 3 pixels"), "{refused}");
        assert!(own.all().is_none() && own.get(0).is_none());
        own.take("first", RgbImage::new(16, 16)).unwrap();
        assert_eq!(own.all().unwrap()[1].size(), (20, 30));
    }
}
