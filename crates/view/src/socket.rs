//! The socket of one page.
//!
//! What a page sends is obeyed only from the page that drives; a stop from any. A page that does not read holds up
//! nothing: its task waits, and later sends the newest frame.

use std::sync::Arc;

use axum::extract::ws::{Message, WebSocket};
use scene::{FromPage, ToPage};
use tokio::sync::broadcast::error::RecvError;

use crate::RecordedRun;
use crate::live_feed::LiveTexts;
use crate::live_pages::{HANDOVER, LivePages};
use crate::teleoperation::Order;

/// Frames of a recorded run in a message.
const FRAMES_PER_MESSAGE: usize = 250;

/// Serves a page of a running robot until it has gone.
pub(crate) async fn serve_live(mut socket: WebSocket, pages: &LivePages) {
    let page = pages.enter();
    // Whatever ends it: the page no longer drives.
    let _ = exchange(&mut socket, pages, page).await;
    pages.set_driver(page, false);
}

/// Sends texts and obeys messages until the page has gone.
async fn exchange(socket: &mut WebSocket, pages: &LivePages, page: u64) -> Result<(), axum::Error> {
    let LiveTexts { scene: mut scenes, floor: mut floors, frame: mut frames } = pages.texts.clone();
    let mut answers = pages.answers.subscribe();
    scenes.mark_changed();
    floors.mark_changed();
    send(socket, pages.driver_text(page)).await?;
    loop {
        let text = tokio::select! {
            // First what the page says: a stop must not wait for frames.
            biased;
            received = socket.recv() => {
                let Some(message) = received.transpose()? else { return Ok(()) };
                obey(&message, pages, page);
                continue;
            }
            answer = answers.recv() => match answer {
                Ok(text) if *text == *HANDOVER => pages.driver_text(page),
                Ok(text) => text,
                Err(RecvError::Lagged(_)) => continue,
                Err(RecvError::Closed) => return Ok(()),
            },
            changed = scenes.changed() => {
                if changed.is_err() {
                    return Ok(());
                }
                scenes.borrow_and_update().clone()
            }
            changed = floors.changed() => {
                if changed.is_err() {
                    return Ok(());
                }
                floors.borrow_and_update().clone()
            }
            changed = frames.changed() => {
                if changed.is_err() {
                    return Ok(());
                }
                frames.borrow_and_update().clone()
            }
        };
        send(socket, text).await?;
    }
}

/// Does what a page says, if it may say so.
fn obey(message: &Message, pages: &LivePages, page: u64) {
    let Message::Text(text) = message else { return };
    let Ok(asked) = serde_json::from_str(text) else { return };
    match asked {
        FromPage::Drive(drives) => pages.set_driver(page, drives),
        FromPage::Stop => pages.order(Order::Stop),
        _ if !pages.is_driver(page) => {}
        FromPage::Beat => pages.order(Order::Beat),
        FromPage::Push(push) => pages.push(push),
        FromPage::Command(line) => pages.order(Order::Line(line.to_string())),
    }
}

async fn send(socket: &mut WebSocket, text: Arc<str>) -> Result<(), axum::Error> {
    socket.send(Message::Text((*text).into())).await
}

/// Sends recorded runs, and then waits until the page has gone.
pub(crate) async fn serve_recorded(mut socket: WebSocket, runs: &[RecordedRun]) {
    // A page that has gone needs nothing.
    if send_runs(&mut socket, runs).await.is_ok() {
        while let Some(Ok(_)) = socket.recv().await {}
    }
}

async fn send_runs(socket: &mut WebSocket, runs: &[RecordedRun]) -> Result<(), axum::Error> {
    for (index, run) in runs.iter().enumerate() {
        let (name, robot, duration) = (run.name.as_str(), &run.robot, run.duration());
        send(socket, ToPage::Run { index, name, robot, duration, frames: run.frames.len() }.text()).await?;
        send(socket, ToPage::Events { index, events: &run.notes }.text()).await?;
        send(socket, ToPage::Floor { index, pieces: &run.floor }.text()).await?;
        for frames in run.frames.chunks(FRAMES_PER_MESSAGE) {
            send(socket, ToPage::Frames { index, frames }.text()).await?;
        }
    }
    Ok(())
}
