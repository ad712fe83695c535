//! Messages have a fixed layout.
//!
//! Other languages lay out the same bytes by hand, and iceoryx2 compares only name, size and alignment: an exchange of
//! two fields would go unnoticed. A change here needs a new `.vN` in the type name and a new `PROTOCOL`.

use std::mem::{align_of, offset_of, size_of};

use wire::{
    MeasurementMessage, PushReplyMessage, PushRequestMessage, ReplyMessage, ReportMessage, RequestMessage,
    SetpointMessage, TruePoseMessage,
};

/// Checks size and alignment, each field's offset, and that fields follow each other without a gap.
macro_rules! assert_layout {
    ($message:ident, $size:literal, { $($field:ident @ $offset:literal + $length:literal),+ $(,)? }) => {
        assert_eq!(size_of::<$message>(), $size, "size of {}", stringify!($message));
        assert_eq!(align_of::<$message>(), 8, "alignment of {}", stringify!($message));
        let mut end = 0;
        $(
            assert_eq!(offset_of!($message, $field), $offset, "{}::{}", stringify!($message), stringify!($field));
            assert_eq!(end, $offset, "padding before {}::{}", stringify!($message), stringify!($field));
            end = $offset + $length;
        )+
        assert_eq!(end, $size, "padding at the end of {}", stringify!($message));
        // Named one by one, so that a new field does not compile until it is listed above.
        let _ = |message: $message| { let $message { $($field: _),+ } = message; };
    };
}

#[test]
fn setpoint_message_has_a_fixed_layout() {
    assert_layout!(SetpointMessage, 496, {
        tick @ 0 + 8, time_ns @ 8 + 8, angles @ 16 + 160, rates @ 176 + 160, feed_forward @ 336 + 160,
    });
}

#[test]
fn push_messages_have_a_fixed_layout() {
    assert_layout!(PushRequestMessage, 40, { link @ 0 + 8, impulse @ 8 + 24, duration @ 32 + 8 });
    assert_layout!(PushReplyMessage, 16, { outcome @ 0 + 8, start @ 8 + 8 });
}

#[test]
fn true_pose_message_has_a_fixed_layout() {
    assert_layout!(TruePoseMessage, 72, { tick @ 0 + 8, time_ns @ 8 + 8, position @ 16 + 24, orientation @ 40 + 32 });
}

#[test]
fn measurement_message_has_a_fixed_layout() {
    assert_layout!(MeasurementMessage, 688, {
        tick @ 0 + 8, time_ns @ 8 + 8, sample @ 16 + 8, angles @ 24 + 160, rates @ 184 + 160, wrench_right @ 344 + 48,
        wrench_left @ 392 + 48, imu_orientation @ 440 + 32, imu_rate @ 472 + 24, motor_current @ 496 + 160,
        imu_specific_force @ 656 + 24, missing @ 680 + 8,
    });
}

#[test]
fn request_message_has_a_fixed_layout() {
    assert_layout!(RequestMessage, 696, {
        not_before @ 0 + 8, present @ 8 + 4, intent @ 12 + 4, source @ 16 + 4, lasting @ 20 + 4, turn @ 24 + 8,
        speed @ 32 + 8, extension @ 40 + 8, sidestep @ 48 + 8, velocity @ 56 + 24, places @ 80 + 576,
        place_count @ 656 + 4, place_kind @ 660 + 4, place_frame @ 664 + 4, place_marks @ 668 + 4,
        age_limit @ 672 + 8, id @ 680 + 8, expires_ns @ 688 + 8,
    });
}

#[test]
fn reply_message_has_a_fixed_layout() {
    assert_layout!(ReplyMessage, 184, {
        id @ 0 + 8, verdict @ 8 + 4, reason @ 12 + 4, effect_half_step @ 16 + 8, turn @ 24 + 8, speed @ 32 + 8,
        extension @ 40 + 8, sidestep @ 48 + 8, step_ahead @ 56 + 8, step_aside @ 64 + 8, velocity @ 72 + 24,
        intent @ 96 + 4, known @ 100 + 4, joint @ 104 + 4, source @ 108 + 4, value @ 112 + 8, limit @ 120 + 8,
        remaining @ 128 + 8, predicted_margin @ 136 + 8, mode @ 144 + 4, fault @ 148 + 4, fault_time @ 152 + 8,
        cause @ 160 + 4, sensor @ 164 + 4, place @ 168 + 8, arrival @ 176 + 8,
    });
}

#[test]
fn report_message_has_a_fixed_layout() {
    assert_layout!(ReportMessage, 480, {
        tick @ 0 + 8, time_ns @ 8 + 8, mode @ 16 + 4, support @ 20 + 4, half_step @ 24 + 8, progress @ 32 + 8,
        speed @ 40 + 8, turn @ 48 + 8, extension @ 56 + 8, sidestep @ 64 + 8, zmp_in_support @ 72 + 16,
        zmp_planned @ 88 + 16, margin @ 104 + 8, lean @ 112 + 16, added @ 128 + 32, com_in_support @ 160 + 24,
        com_velocity_in_support @ 184 + 24, com_planned @ 208 + 24, com_velocity_planned @ 232 + 24, pose @ 256 + 24,
        walk_velocity @ 280 + 24, support_sole @ 304 + 24, landing @ 328 + 24, landing_after @ 352 + 24,
        destination @ 376 + 4, destination_places_left @ 380 + 4, destination_distance @ 384 + 8,
        destination_turn @ 392 + 8, capturability @ 400 + 4, contact @ 404 + 4, external_force @ 408 + 16,
        com_offset @ 424 + 16, gyro_bias @ 440 + 24, faults @ 464 + 4, missed @ 468 + 4, compute_ns @ 472 + 8,
    });
}
