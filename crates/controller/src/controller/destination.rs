//! The walk to a destination: it is corrected by odometry, and reported.

use interface::{DestinationProgress, Intent, Source};
use pattern::{GaitState, Stance};

use super::Controller;
use crate::localization::Localization;
use crate::pattern::Pattern;

impl Controller {
    /// Where the robot is, as odometry estimates it.
    pub(super) fn localization(&self) -> Localization {
        Localization { pose: self.odometry.pose(), support_sole: self.odometry.support_sole() }
    }

    /// Corrects the way to a destination, if there is one. Once the robot has arrived it is to stand.
    pub(super) fn follow_destination(&mut self) {
        let support_sole = self.odometry.support_sole();
        let Pattern::Planned(generator) = &mut self.pattern else { return };
        if generator.destination().is_some() {
            generator.locate(&support_sole);
            if self.state.intent() == Intent::Walk && generator.has_arrived() {
                let parallel = generator.gait_state() == GaitState::Standing(Stance::Parallel);
                self.state.set_intent(if parallel { Intent::Stop } else { Intent::Hold });
            }
        }
    }

    /// Whether the robot walks to a destination of a source that outranks this one: that ends by itself in a stand,
    /// whatever becomes of this source's stream.
    pub(super) fn walks_for_a_superior_of(&self, source: Source) -> bool {
        let Pattern::Planned(generator) = &self.pattern else { return false };
        generator.destination().is_some()
            && self.destination_source.is_some_and(|sender| self.arbiter.outranks(sender, source))
    }

    /// How far the walk to a destination has come, if there is one.
    pub(super) fn destination_progress(&self) -> Option<DestinationProgress> {
        let Pattern::Planned(generator) = &self.pattern else { return None };
        let (places, left) = generator.destination()?;
        Some(self.localization().progress(places, left))
    }
}
