//! Frame headers (ITU-T T.81, annex B.2.2).

/// An image of eight bits per channel.
pub(super) struct Frame {
    pub(super) progressive: bool,
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) components: Vec<Component>,
}

/// A channel of brightness or color.
pub(super) struct Component {
    pub(super) id: u8,
    /// Number of blocks across in a unit of all components.
    pub(super) wide: u32,
    /// Number of blocks down in a unit of all components.
    pub(super) high: u32,
    /// Nonzero coefficients of each block of a progressive file, allocated when needed.
    pub(super) known: Vec<u64>,
    /// Whether a scan contained it.
    pub(super) has_scan: bool,
}

impl Frame {
    /// Reads a frame header; `None` if it is not supported here.
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
            has_scan: false,
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

    /// Returns the maximum numbers of blocks of a component in a unit, across and down.
    pub(super) fn unit(&self) -> (u32, u32) {
        let most = |of: fn(&Component) -> u32| self.components.iter().map(of).max().unwrap_or(1);
        (most(|c| c.wide), most(|c| c.high))
    }

    pub(super) fn pixels(&self) -> u64 {
        u64::from(self.width) * u64::from(self.height)
    }

    /// Returns whether every component was in a scan.
    pub(super) fn is_complete(&self) -> bool {
        self.components.iter().all(|c| c.has_scan)
    }
}
