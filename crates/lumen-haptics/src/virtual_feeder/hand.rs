//! A mass on a motor, and the hand that holds it: a spring and a damper to where the hand wants it (a grip's stiffness and
//! damping are those of a finger by Hogan, 1989, and Kuchenbecker, Park & Niemeyer, 2003: 100 to 1000 N/m, 1 to 10 N s/m).

use crate::feeder::HALF_WAY;

/// Steps of the integration in a ms.
const FINE: u32 = 10;

/// One axis and the hand on it, in mm, N, s; or in radians, N mm, s.
#[derive(Clone, Copy, Debug)]
pub struct Hand {
    /// Where it is.
    pub place: f64,
    /// How fast it goes.
    pub speed: f64,
    /// Where the hand wants it.
    pub wanted: f64,
    /// How stiffly the hand holds it, by mm or radian; 0 lets it go.
    pub grip: f64,
    /// How the hand damps it, by mm/s or radian/s.
    pub calm: f64,
    /// What the motor gives at most, in N or N mm.
    pub most_force: f64,
    /// The work that the device, its motor less its drag, has done on the hand and the mass, in N mm.
    pub work: f64,
    mass: f64,
    drag: f64,
    half_way: f64,
}

impl Hand {
    /// On the feed: 100 g, 5 N.
    pub(super) fn feed() -> Self {
        Self {
            place: 0.0,
            speed: 0.0,
            wanted: 0.0,
            grip: 0.3,
            calm: 0.003,
            most_force: 5.0,
            work: 0.0,
            // t: 1 N moves 1 t by 1 mm/s^2.
            mass: 1e-4,
            drag: 5e-4,
            half_way: HALF_WAY[0],
        }
    }

    /// On the roll: a knob of 20 mm and 50 g, 50 N mm.
    pub(super) fn roll() -> Self {
        Self { grip: 60.0, calm: 0.3, most_force: 50.0, mass: 1e-2, drag: 4e-2, half_way: HALF_WAY[1], ..Self::feed() }
    }

    /// Where it is on its way, -1 to 1.
    pub fn part(&self) -> f64 {
        self.place / self.half_way
    }

    pub(super) fn part_per_s(&self) -> f64 {
        self.speed / self.half_way
    }

    /// Lets a ms pass under a force of the motor.
    pub(super) fn advance(&mut self, force: f64) {
        let dt = 1e-3 / f64::from(FINE);
        for _ in 0..FINE {
            let held = self.grip * (self.wanted - self.place) - self.calm * self.speed;
            self.speed += dt * (force + held - self.drag * self.speed) / self.mass;
            let before = self.place;
            self.place = (before + dt * self.speed).clamp(-self.half_way, self.half_way);
            if self.place.abs() >= self.half_way {
                self.speed = 0.0;
            }
            self.work += (force - self.drag * self.speed) * (self.place - before);
        }
    }
}
