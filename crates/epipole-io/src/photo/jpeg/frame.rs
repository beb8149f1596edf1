//! Frame headers (ITU-T T.81, annex B.2.2).

/// A picture of eight bits a channel.
pub(super) struct Frame {
    pub(super) progressive: bool,
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) components: Vec<Component>,
}

/// A channel of brightness or color.
pub(super) struct Component {
    pub(super) id: u8,
    /// Blocks side by side in a unit of all components.
    pub(super) wide: u32,
    /// Blocks one above the other in such a unit.
    pub(super) high: u32,
    /// Of a progressive file, once it is needed: which coefficients of a block are not zero.
    pub(super) known: Vec<u64>,
    /// Whether a scan had it.
    pub(super) seen: bool,
}

impl Frame {
    /// `None` if it is none that is known here.
    pub(super) fn read(segment: &[u8], progressive: bool) -> Option<Self> {
        let (&[precision, h0, h1, w0, w1, count], parts) = segment.split_first_chunk::<6>()?;
        let height = u32::from(u16::from_be_bytes([h0, h1]));
        let width = u32::from(u16::from_be_bytes([w0, w1]));
        let parts = parts.get(..3 * usize::from(count))?;
        let components = (parts.chunks_exact(3).map(|part| Component {
            id: part[0],
            wide: u32::from(part[1] >> 4),
            high: u32::from(part[1] & 15),
            known: Vec::new(),
            seen: false,
        }))
        .collect::<Vec<_>>();
        let fits = |size: u32| (1..=4).contains(&size);
        let known = precision == 8
            && width > 0
            && height > 0
            && (1..=4).contains(&count)
            && components.iter().all(|c| fits(c.wide) && fits(c.high));
        known.then_some(Self {
            progressive,
            width,
            height,
            components,
        })
    }

    /// The most blocks of a component in a unit, side by side and one above the other.
    pub(super) fn unit(&self) -> (u32, u32) {
        let most = |of: fn(&Component) -> u32| self.components.iter().map(of).max().unwrap_or(1);
        (most(|c| c.wide), most(|c| c.high))
    }

    pub(super) fn pixels(&self) -> u64 {
        u64::from(self.width) * u64::from(self.height)
    }

    /// Whether a scan had each component.
    pub(super) fn is_complete(&self) -> bool {
        self.components.iter().all(|c| c.seen)
    }
}
