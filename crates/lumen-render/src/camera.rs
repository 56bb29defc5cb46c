//! The eye of a view: a turntable about a target, with the patient's head up.
//!
//! World axes are the patient's, as DICOM has them: x to the left, y to the back, z to the head (LPS), in mm. The
//! camera turns about the world's z and about its own horizontal, so the head never tilts. It looks along its own -z.
//!
//! Depth runs backwards (1 at the near plane, 0 at the far plane): floating-point depth then resolves far and near
//! alike (Lapidous and Jiao 1999; Reed, "Depth Precision Visualized", 2015). Both planes are fitted to the bounds of
//! what is shown, which keeps the precision where a platform maps depth to -1..1 (WebGL2) as well.

use std::f32::consts::{FRAC_PI_2, PI};

use glam::{Mat3, Mat4, Quat, Vec2, Vec3, Vec4};

use super::{Ray, StandardView};
use lumen_mesh::Bounds;

/// Turn for a drag across the whole height of a view, in radians.
const TURN_PER_HEIGHT: f32 = PI;
/// Room around a fitted surface: this much of the view stays free.
const FIT_MARGIN: f32 = 1.08;
/// Nearest plane as a fraction of the farthest, where the eye is within the surface's sphere.
const NEAR_FRACTION: f32 = 1e-3;
/// Closest and farthest distance to the target, in diagonals of the bounds.
const DISTANCE_RANGE: [f32; 2] = [1e-3, 20.0];

/// A perspective camera that turns about a target.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// The point the camera turns about, in mm; the middle of the view.
    pub target: Vec3,
    /// Camera-to-world rotation.
    pub rotation: Quat,
    /// From the eye to the target, in mm; above zero.
    pub distance: f32,
    /// Vertical field of view in radians, 0 to pi.
    pub fov_y: f32,
    /// What is shown, in mm: the near and far planes are fitted to it. [`Bounds::EMPTY`] for nothing.
    pub bounds: Bounds,
    /// With the eye within the bounds, the near plane is no farther from it than this, in mm. With infinity, the default,
    /// it is where depth is precise.
    pub nearest_mm: f32,
}

impl Default for Camera {
    /// 1 m in front of the origin, with a narrow field of view (30 degrees) that distorts little.
    fn default() -> Self {
        Self {
            target: Vec3::ZERO,
            rotation: StandardView::Anterior.rotation(),
            distance: 1000.0,
            fov_y: PI / 6.0,
            bounds: Bounds::EMPTY,
            nearest_mm: f32::INFINITY,
        }
    }
}

impl Camera {
    /// Moves the target to the middle of `bounds` and the eye to where all of it is in view, at `aspect` = width /
    /// height, keeping the direction of view. Empty bounds change nothing but the planes.
    pub fn fit(&mut self, bounds: &Bounds, aspect: f32) {
        self.bounds = *bounds;
        if bounds.is_empty() {
            return;
        }
        self.target = bounds.centre();
        let (half_x, half_y) = self.half_extents(aspect);
        let to_camera = self.rotation.inverse();
        let nearest = corners(bounds)
            .map(|corner| {
                let p = to_camera * (corner - self.target);
                p.z + FIT_MARGIN * (p.x.abs() / half_x).max(p.y.abs() / half_y)
            })
            .into_iter()
            .fold(0.0, f32::max);
        // A single point has no size to fit: any distance shows it.
        self.distance = if nearest > 0.0 { nearest } else { 1.0 };
    }

    /// Looks at a place from as near as `height_mm` fill the height of the view at its depth, keeping the direction.
    pub fn focus(&mut self, at: Vec3, height_mm: f32) {
        self.target = at;
        if height_mm.is_finite() && height_mm > 0.0 {
            self.distance = height_mm / (2.0 * (self.fov_y / 2.0).tan());
        }
    }

    /// Looks against `way`, from where it points, with the head up; nothing changes where it points up or down.
    pub fn face(&mut self, way: Vec3) {
        let back = way.normalize_or_zero();
        let right = Vec3::Z.cross(back);
        if right.length() > 1e-3 {
            let right = right.normalize();
            self.rotation = Quat::from_mat3(&Mat3::from_cols(right, back.cross(right), back));
        }
    }

    /// Turns about the target by a drag of `delta`, in fractions of the view's height, x to the right and y down: the
    /// surface follows the hand, and a drag over the whole height is half a turn. Stops where the eye is right above
    /// or below the target.
    pub fn orbit(&mut self, delta: Vec2) {
        let elevation = (self.rotation * Vec3::Z).z.atan2((self.rotation * Vec3::Y).z);
        let turned = (elevation + TURN_PER_HEIGHT * delta.y).clamp(-FRAC_PI_2, FRAC_PI_2);
        let yaw = Quat::from_rotation_z(-TURN_PER_HEIGHT * delta.x);
        self.rotation = (yaw * self.rotation * Quat::from_rotation_x(elevation - turned)).normalize();
    }

    /// Moves sideways by a drag of `delta`, in fractions of the view's height, x to the right and y down: what is at
    /// the target's depth stays under the hand.
    pub fn pan(&mut self, delta: Vec2) {
        let height_mm = 2.0 * self.distance * (self.fov_y / 2.0).tan();
        self.target += self.rotation * (Vec3::new(-delta.x, delta.y, 0.0) * height_mm);
    }

    /// Comes `factor` times nearer (above 1) or farther (below 1), keeping what is at the target's depth and at `at`,
    /// in normalised device coordinates (-1..1, y up), where it is.
    pub fn zoom(&mut self, factor: f32, at: Vec2, aspect: f32) {
        let (half_x, half_y) = self.half_extents(aspect);
        let offset = Vec3::new(at.x * half_x, at.y * half_y, 0.0) * self.distance;
        self.zoom_about(factor, self.target + self.rotation * offset);
    }

    /// As [`Self::zoom`], keeping the point `pivot`, in mm, exactly where it is in the view: the camera is scaled
    /// about it. A factor that is not a positive number is ignored; the distance stays within a thousandth and twenty
    /// diagonals of the bounds.
    pub fn zoom_about(&mut self, factor: f32, pivot: Vec3) {
        if !(factor.is_finite() && factor > 0.0) {
            return;
        }
        let mut distance = self.distance / factor;
        let diagonal = self.bounds.diagonal();
        if diagonal > 0.0 {
            // An eye that is out of range already may stay there, but goes no farther.
            let [low, high] = DISTANCE_RANGE.map(|range| range * diagonal);
            distance = distance.clamp(low.min(self.distance), high.max(self.distance));
        }
        self.target = pivot + (self.target - pivot) * (distance / self.distance);
        self.distance = distance;
    }

    /// Looks from one of the six sides; target and distance stay.
    pub fn standard_view(&mut self, view: StandardView) {
        self.rotation = view.rotation();
    }

    /// Where the eye is, in mm.
    pub fn eye(&self) -> Vec3 {
        self.target + self.rotation * Vec3::new(0.0, 0.0, self.distance)
    }

    /// World to camera coordinates, in mm: x right, y up, z towards the eye.
    pub fn view(&self) -> Mat4 {
        let to_camera = self.rotation.inverse();
        Mat4::from_rotation_translation(to_camera, -(to_camera * self.target) - Vec3::new(0.0, 0.0, self.distance))
    }

    /// Camera to clip coordinates: depth from 1 at the near plane to 0 at the far plane.
    pub fn projection(&self, aspect: f32) -> Mat4 {
        let (half_x, half_y) = self.half_extents(aspect);
        let [near, far] = self.planes();
        let span = far - near;
        Mat4::from_cols(
            Vec4::new(1.0 / half_x, 0.0, 0.0, 0.0),
            Vec4::new(0.0, 1.0 / half_y, 0.0, 0.0),
            Vec4::new(0.0, 0.0, near / span, -1.0),
            Vec4::new(0.0, 0.0, near * far / span, 0.0),
        )
    }

    /// World to clip coordinates, for `aspect` = width / height.
    pub fn view_projection(&self, aspect: f32) -> Mat4 {
        self.projection(aspect) * self.view()
    }

    /// Where `point` is in the view, in normalised device coordinates (-1..1, y up); `None` behind the eye.
    pub fn project(&self, point: Vec3, aspect: f32) -> Option<Vec2> {
        let (half_x, half_y) = self.half_extents(aspect);
        let p = self.view().transform_point3(point);
        (p.z < 0.0).then(|| Vec2::new(p.x / (half_x * -p.z), p.y / (half_y * -p.z)))
    }

    /// The ray from the eye through `at`, in normalised device coordinates (-1..1, y up).
    pub fn ray(&self, at: Vec2, aspect: f32) -> Ray {
        let (half_x, half_y) = self.half_extents(aspect);
        let direction = self.rotation * Vec3::new(at.x * half_x, at.y * half_y, -1.0);
        Ray { origin: self.eye(), direction: direction.normalize() }
    }

    /// Size of a pixel at the target, in mm, in a view `height_px` pixels high: what a scale bar needs.
    pub fn mm_per_pixel(&self, height_px: f32) -> f32 {
        2.0 * self.distance * (self.fov_y / 2.0).tan() / height_px
    }

    /// The world's x, y and z in camera coordinates (x right, y up, z towards the eye): what an orientation marker
    /// needs.
    pub fn axes(&self) -> [Vec3; 3] {
        let to_camera = self.rotation.inverse();
        [Vec3::X, Vec3::Y, Vec3::Z].map(|axis| to_camera * axis)
    }

    /// Distance of the near and far planes from the eye, in mm: around the sphere about the bounds.
    fn planes(&self) -> [f32; 2] {
        let radius = 0.505 * self.bounds.diagonal();
        let middle = (self.eye() - self.bounds.centre()).dot(self.rotation * Vec3::Z);
        if radius <= 0.0 || middle + radius <= 0.0 {
            return [NEAR_FRACTION * self.distance, 2.0 * self.distance];
        }
        let far = middle + radius;
        [(middle - radius).max((NEAR_FRACTION * far).min(self.nearest_mm)), far]
    }

    /// Half the width and height of the view at distance 1.
    fn half_extents(&self, aspect: f32) -> (f32, f32) {
        let half_y = (self.fov_y / 2.0).tan();
        (half_y * aspect, half_y)
    }
}

/// The eight corners of a box.
fn corners(bounds: &Bounds) -> [Vec3; 8] {
    let (min, max) = (Vec3::from(bounds.min), Vec3::from(bounds.max));
    std::array::from_fn(|i| {
        Vec3::new(
            if i & 1 == 0 { min.x } else { max.x },
            if i & 2 == 0 { min.y } else { max.y },
            if i & 4 == 0 { min.z } else { max.z },
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const ASPECTS: [f32; 3] = [0.5, 1.0, 2.2];

    fn aorta() -> Bounds {
        Bounds { min: [-60.0, 110.0, -400.0], max: [75.0, 190.0, -120.0] }
    }

    /// A camera on the aorta from somewhere oblique.
    fn oblique(aspect: f32) -> Camera {
        let mut camera = Camera::default();
        camera.orbit(Vec2::new(0.21, 0.13));
        camera.fit(&aorta(), aspect);
        camera
    }

    #[test]
    fn a_fitted_box_is_in_view_from_everywhere_and_fills_it() {
        for aspect in ASPECTS {
            for view in StandardView::ALL {
                for turn in 0..5 {
                    let mut camera = Camera::default();
                    camera.standard_view(view);
                    camera.orbit(Vec2::splat(0.11 * turn as f32));
                    camera.fit(&aorta(), aspect);
                    let matrix = camera.view_projection(aspect);
                    let mut largest = 0.0_f32;
                    for corner in corners(&aorta()) {
                        let clip = matrix.project_point3(corner);
                        assert!(clip.x.abs() <= 1.0 && clip.y.abs() <= 1.0 && (0.0..=1.0).contains(&clip.z), "{clip}");
                        assert!(clip.truncate().abs_diff_eq(camera.project(corner, aspect).unwrap(), 1e-4));
                        largest = largest.max(clip.x.abs()).max(clip.y.abs());
                    }
                    assert!(largest > 0.9, "{view:?} {aspect}: {largest}");
                }
            }
        }
    }

    #[test]
    fn standard_views_put_the_patient_where_radiology_does() {
        use StandardView::{Anterior, Inferior, Left, Posterior, Right, Superior};
        // The world axis on the right of the view, the one that is up, and the one towards the eye.
        for (view, right, up, eye) in [
            (Anterior, Vec3::X, Vec3::Z, Vec3::NEG_Y),
            (Posterior, Vec3::NEG_X, Vec3::Z, Vec3::Y),
            (Left, Vec3::Y, Vec3::Z, Vec3::X),
            (Right, Vec3::NEG_Y, Vec3::Z, Vec3::NEG_X),
            (Superior, Vec3::NEG_X, Vec3::NEG_Y, Vec3::Z),
            (Inferior, Vec3::X, Vec3::NEG_Y, Vec3::NEG_Z),
        ] {
            let mut camera = oblique(1.0);
            let before = camera;
            camera.standard_view(view);
            assert_eq!((camera.target, camera.distance), (before.target, before.distance));
            let towards = (camera.eye() - camera.target) / camera.distance;
            assert!(towards.abs_diff_eq(eye, 1e-5), "{view:?}");
            assert!((camera.rotation * Vec3::X).abs_diff_eq(right, 1e-6), "{view:?}");
            assert!((camera.rotation * Vec3::Y).abs_diff_eq(up, 1e-6), "{view:?}");
        }
    }

    #[test]
    fn zooming_keeps_what_is_under_the_cursor() {
        for aspect in ASPECTS {
            for factor in [0.4, 1.3, 7.0] {
                let at = Vec2::new(0.6, -0.35);
                let mut camera = oblique(aspect);
                let ray = camera.ray(at, aspect);
                let depth = camera.distance / ray.direction.dot(camera.rotation * Vec3::NEG_Z);
                let under = ray.origin + ray.direction * depth;
                let before = camera.distance;
                camera.zoom(factor, at, aspect);
                assert!((camera.distance * factor - before).abs() < 1e-3 * before);
                assert!(camera.project(under, aspect).unwrap().abs_diff_eq(at, 1e-4));

                let pivot = Vec3::new(10.0, 130.0, -200.0);
                let seen = camera.project(pivot, aspect).unwrap();
                camera.zoom_about(1.7, pivot);
                assert!(camera.project(pivot, aspect).unwrap().abs_diff_eq(seen, 1e-4));
            }
        }
    }

    #[test]
    fn zooming_ends_before_the_eye_is_lost() {
        let mut camera = oblique(1.0);
        for _ in 0..400 {
            camera.zoom(2.0, Vec2::new(0.5, 0.5), 1.0);
        }
        assert!(camera.distance > 0.0 && camera.view_projection(1.0).is_finite());
        for _ in 0..400 {
            camera.zoom(0.5, Vec2::ZERO, 1.0);
        }
        assert!(camera.distance.is_finite() && camera.view_projection(1.0).is_finite());
        let before = camera;
        for factor in [0.0, -1.0, f32::NAN, f32::INFINITY] {
            camera.zoom(factor, Vec2::ZERO, 1.0);
        }
        assert_eq!(camera, before);
    }

    #[test]
    fn panning_takes_the_point_under_the_hand_along() {
        for aspect in ASPECTS {
            let mut camera = oblique(aspect);
            let point = camera.target;
            camera.pan(Vec2::new(0.25, 0.1));
            // A quarter of the height to the right, a tenth down: in device coordinates the height is 2.
            let expected = Vec2::new(0.5 / aspect, -0.2);
            assert!(camera.project(point, aspect).unwrap().abs_diff_eq(expected, 1e-5));
        }
    }

    #[test]
    fn a_drag_back_undoes_a_drag_and_the_head_stays_up() {
        let mut camera = oblique(1.0);
        let before = camera;
        for step in [Vec2::new(0.3, 0.1), Vec2::new(-1.4, -0.2)] {
            camera.orbit(step);
            assert!((camera.rotation * Vec3::X).z.abs() < 1e-5, "no roll");
        }
        for step in [Vec2::new(1.4, 0.2), Vec2::new(-0.3, -0.1)] {
            camera.orbit(step);
        }
        assert!(camera.rotation.dot(before.rotation).abs() > 1.0 - 1e-5);
        assert!(camera.eye().abs_diff_eq(before.eye(), 0.05));
    }

    #[test]
    fn a_turn_stops_above_the_head() {
        let mut camera = Camera::default();
        camera.orbit(Vec2::new(0.0, 3.0));
        assert!((camera.rotation * Vec3::Z).abs_diff_eq(Vec3::Z, 1e-3));
        camera.orbit(Vec2::new(0.0, -0.5));
        assert!((camera.rotation * Vec3::Z).abs_diff_eq(Vec3::NEG_Y, 2e-3));
    }

    #[test]
    fn a_drag_right_turns_the_front_to_the_right() {
        let mut camera = Camera::default();
        camera.orbit(Vec2::new(0.1, 0.0));
        assert!(camera.project(Vec3::new(0.0, -50.0, 0.0), 1.0).unwrap().x > 0.0);
        let mut camera = Camera::default();
        camera.orbit(Vec2::new(0.0, 0.1));
        assert!(camera.project(Vec3::new(0.0, -50.0, 0.0), 1.0).unwrap().y < 0.0);
    }

    #[test]
    fn scale_and_axes_are_those_of_the_view() {
        let camera = oblique(1.0);
        let [x, y, z] = camera.axes();
        let view = camera.view();
        for (axis, seen) in [(Vec3::X, x), (Vec3::Y, y), (Vec3::Z, z)] {
            assert!(view.transform_vector3(axis).abs_diff_eq(seen, 1e-6));
        }
        // 800 pixels for 2 units of device coordinates.
        let aside = camera.target + camera.rotation * Vec3::X * camera.mm_per_pixel(800.0) * 100.0;
        assert!((camera.project(aside, 1.0).unwrap().x - 0.25).abs() < 1e-4);
    }

    #[test]
    fn near_is_one_and_far_is_zero() {
        let camera = oblique(1.3);
        let [near, far] = camera.planes();
        let forward = camera.rotation * Vec3::NEG_Z;
        let matrix = camera.view_projection(1.3);
        assert!((matrix.project_point3(camera.eye() + forward * near).z - 1.0).abs() < 1e-3);
        assert!(matrix.project_point3(camera.eye() + forward * far).z.abs() < 1e-3);
    }
}
