//! The velocity diagram laid off from instant centres, so that the acceleration polygon is fed with their ω
//! (`s000-ch3b` A 20): centres give no accelerations, but all that the normal parts and Coriolis need.

use crate::board::Line;
use crate::mechanism::quantity::{Method, Order, Quantity};
use crate::mechanism::structure::GroupKind;
use crate::mechanism::{LinkId, PointId};
use crate::plan::Plan;

use super::super::construction::{Act, Claim, Label, Reference, VectorKind};
use super::super::draughtsman::Draughtsman;
use super::velocities::Why;

const ROLLING: Why =
    "a wheel that rolls at the end of a rod: this version finds no accelerations from centres there";

/// Lays off the velocities of the planned links from a pole, each found from its link's centre.
///
/// # Errors
/// Why the centres do not lead to one of them.
pub(in super::super) fn draw(d: &mut Draughtsman<'_>, plan: &Plan) -> Result<(), Why> {
    d.open_polygon(Order::Velocity);
    let rest = d.rest();
    d.set_rate(Order::Velocity, LinkId::FRAME, rest);
    d.step(Order::Velocity, &[], Vec::new());
    d.act(Act::MarkPole);
    for step in plan.steps(Order::Velocity) {
        let group = &d.structure.groups[step.group];
        if matches!(group.kind, GroupKind::Rolling { .. }) {
            return Err(ROLLING);
        }
        d.board.purpose("velocities from centres");
        d.step(Order::Velocity, &group.links, Vec::new());
        for &link in &group.links {
            d.lay_off_velocities(link)?;
        }
        for slide in 0..d.mechanism.slides.len() {
            d.sliding_from_centres(slide);
        }
        for &link in &group.links {
            d.note_link_image(Order::Velocity, link);
        }
    }
    Ok(())
}

impl Draughtsman<'_> {
    /// What is found from centres, with every line that leads to it, each told once.
    fn derived<T>(&mut self, find: impl FnOnce(&mut Self) -> Result<T, Why>) -> Result<T, Why> {
        // The lines of a transfer that nobody asked for belong to this step.
        self.open_transfer(0, Method::Centres);
        let found = find(self);
        let told = self.transfers_mut().and_then(Vec::pop).into_iter().flat_map(|transfer| transfer.acts);
        for act in told.map(Act::ByCentres).collect::<Vec<_>>() {
            if !self.record().steps.iter().any(|step| step.acts.contains(&act)) {
                self.act(act);
            }
        }
        found
    }

    /// ω of a link and the velocities of its points, from its centre.
    fn lay_off_velocities(&mut self, link: LinkId) -> Result<(), Why> {
        let omega = self.derived(|d| d.omega_of(link, true))?;
        self.set_rate(Order::Velocity, link, omega);
        for point in self.mechanism.link(link).points.clone() {
            let standing = self.places[point.0].is_some() && !self.mechanism.is_fixed(point);
            if !standing || self.motion(Order::Velocity).images[point.0].is_some() {
                continue;
            }
            let velocity = self.derived(|d| d.velocity_of_point(point, link, true))?;
            let scale = self.polygon_scale(Order::Velocity);
            let by = velocity.map(|v| self.board.to_paper(v, scale));
            let pole = self.board.origin();
            let image = self.board.moved(pole, by);
            self.note_image(Order::Velocity, point, image);
            let label = self.label(point);
            let vector = self.note_vector(
                Order::Velocity,
                (VectorKind::Absolute, Quantity::Velocity(point), None),
                (Label::Pole, pole),
                (label, image),
            );
            let value = libm::hypot(velocity[0].value(), velocity[1].value());
            let mm = libm::hypot(by[0].value(), by[1].value());
            self.act(Act::LayOffFromCentre { vector, link, value, mm });
        }
        Ok(())
    }

    /// The sliding velocity in a pair both of whose links are known: from the guide's point under the rider to the
    /// rider.
    fn sliding_from_centres(&mut self, slide: usize) {
        let pair = self.mechanism.slides[slide];
        let guide = pair.guide.link;
        let rider = self.riding_point(slide, PointId(0));
        let rides_on =
            self.motion(Order::Velocity).images[rider.0].is_some() || self.mechanism.is_fixed(rider);
        if self.motion(Order::Velocity).slidings[slide].is_some()
            || self.motion(Order::Velocity).rotations[guide.0].is_none()
            || !rides_on
        {
            return;
        }
        let under = self.image_under(Order::Velocity, rider, guide);
        let image = self.image(Order::Velocity, rider);
        let (along, _) = self.tangent(slide, rider);
        let [mm, _] = self.board.square_off(Line { through: under, along }, image);
        let scale = self.polygon_scale(Order::Velocity);
        let read = self.board.read(mm, scale);
        self.motion_mut(Order::Velocity).slidings[slide] = Some(read);
        self.note_part(Quantity::Slip(rider, guide), under, image);
        if guide != LinkId::FRAME {
            let claim = Claim::Parallel(Reference::Guide(slide));
            let (tail, head) = ((self.label_under(rider, guide), under), (self.label(rider), image));
            let quantity = Quantity::Slip(rider, guide);
            let vector =
                self.note_vector(Order::Velocity, (VectorKind::Sliding, quantity, Some(claim)), tail, head);
            self.act_read(Order::Velocity, vector);
        }
    }
}
