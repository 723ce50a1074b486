//! From the pixels of a scan to millimetres of paper.

/// A scan: scale, rotation and shift, by two points known in both.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scan {
    /// Millimetres per pixel along the paper's x and y for a step to the right of the scan.
    along: [f64; 2],
    pixel: [f64; 2],
    mm: [f64; 2],
}

impl Scan {
    /// From two points in pixels (x to the right, y down) and in millimetres (x to the right, y up); `None` where
    /// the two are one.
    #[must_use]
    pub fn new(pixels: [[f64; 2]; 2], mm: [[f64; 2]; 2]) -> Option<Self> {
        let [px, py] = [pixels[1][0] - pixels[0][0], pixels[0][1] - pixels[1][1]];
        let [mx, my] = [mm[1][0] - mm[0][0], mm[1][1] - mm[0][1]];
        let square = px * px + py * py;
        if square == 0.0 || mx * mx + my * my == 0.0 {
            return None;
        }
        let along = [(mx * px + my * py) / square, (my * px - mx * py) / square];
        along.iter().all(|x| x.is_finite()).then_some(Self { along, pixel: pixels[0], mm: mm[0] })
    }

    /// A pixel on the paper.
    #[must_use]
    pub fn to_paper(&self, pixel: [f64; 2]) -> [f64; 2] {
        let [x, y] = [pixel[0] - self.pixel[0], self.pixel[1] - pixel[1]];
        let [a, b] = self.along;
        [self.mm[0] + a * x - b * y, self.mm[1] + b * x + a * y]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A scan at 254 dpi, turned by a quarter: ten pixels are a millimetre, the paper's x runs down.
    #[test]
    fn a_turned_scan_is_turned_back() {
        let scan = Scan::new([[100.0, 100.0], [100.0, 600.0]], [[0.0, 0.0], [50.0, 0.0]]).unwrap();
        let close = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).abs() < 1e-12 && (a[1] - b[1]).abs() < 1e-12;
        assert!(close(scan.to_paper([100.0, 100.0]), [0.0, 0.0]));
        assert!(close(scan.to_paper([100.0, 350.0]), [25.0, 0.0]));
        assert!(close(scan.to_paper([200.0, 100.0]), [0.0, 10.0]));
        assert!(Scan::new([[1.0, 1.0]; 2], [[0.0, 0.0], [50.0, 0.0]]).is_none());
    }
}
