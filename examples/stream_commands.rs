//! Streams commands to a controller that runs in another process: faster and slower, to the left and to the right. When
//! this program ends without closing its stream, the robot stops.
//!
//! ```text
//! cargo run --release -- walk --instance demo --for 60s     in one terminal
//! cargo run --release --example stream_commands -- demo     in another
//! ```

use std::error::Error;
use std::thread::sleep;
use std::time::{Duration, Instant};

use interface::{GaitChange, Request, Source};
use operator::CommandStream;
use wire::Instance;

/// Time between two commands.
const COMMAND_PERIOD: Duration = Duration::from_secs(2);
/// How often the stream is kept alive between them.
const KEEP_ALIVE_PERIOD: Duration = Duration::from_millis(5);

fn main() -> Result<(), Box<dyn Error>> {
    let name = std::env::args().nth(1).ok_or("name the instance, for example `demo`")?;
    let mut stream = CommandStream::connect(&Instance::new(&name)?, None)?;

    for (turn_deg, speed) in [(0.0, 1.2), (15.0, 1.0), (-15.0, 1.0), (0.0, 0.8), (0.0, 1.0)] {
        let gait = GaitChange { turn: Some(f64::to_radians(turn_deg)), speed: Some(speed), ..GaitChange::NONE };
        let reply = stream.request(&Request { gait, ..Request::new(Source::Program) })?;
        println!("turn {turn_deg}°, speed {speed}: {} from half-step {}", reply.verdict, reply.effect_half_step);

        let next = Instant::now() + COMMAND_PERIOD;
        while Instant::now() < next {
            stream.keep_alive()?;
            sleep(KEEP_ALIVE_PERIOD);
        }
    }
    // The last command stays in effect.
    Ok(stream.close()?)
}
