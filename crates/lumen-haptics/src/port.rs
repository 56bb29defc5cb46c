//! A device that can be talked to: what a transport has to give where it can wait for an answer. In the browser nothing can
//! wait; there requests go out and replies come in as messages.

use super::force::{Reply, Request};
use lumen_message::messages;

messages! {
    /// Why a report did not get through.
    #[derive(Clone, Debug, PartialEq, Eq)]
    pub enum PortError {
        /// The device is gone.
        "devices-gone" Gone => "the device is no longer there",
        /// It does not take this report.
        "devices-report-refused" Refused {
            /// Its id.
            id: u8,
            /// What the system says.
            reason: String,
        } => "the device does not take report {id}: {reason}",
    }
}

/// An input report.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct InputReport {
    /// Its id; 0 where the device has none.
    pub id: u8,
    /// Its bytes, without the id.
    pub data: Vec<u8>,
}

/// A device that can be talked to. Bytes are without ids.
pub trait Port: Send {
    /// Its report descriptor.
    fn descriptor(&self) -> &[u8];

    /// That of another interface of the same device, to which reports are sent; `None` where they go to this one.
    fn force_descriptor(&self) -> Option<&[u8]> {
        None
    }

    /// Sends an output report.
    ///
    /// # Errors
    /// When the device is gone or does not take it.
    fn send(&mut self, id: u8, data: &[u8]) -> Result<(), PortError>;

    /// Sets a feature report.
    ///
    /// # Errors
    /// As for [`Port::send`].
    fn set_feature(&mut self, id: u8, data: &[u8]) -> Result<(), PortError>;

    /// Gets a feature report of so many bytes; some systems put its id before it.
    ///
    /// # Errors
    /// As for [`Port::send`].
    fn get_feature(&mut self, id: u8, bytes: usize) -> Result<Vec<u8>, PortError>;

    /// The oldest input report that was not polled yet; does not wait for one.
    ///
    /// # Errors
    /// When the device is gone.
    fn poll(&mut self) -> Result<Option<InputReport>, PortError>;
}

/// Carries out a request and hands what came of it to `hear`.
///
/// # Errors
/// When the device is gone; that it refuses a report is a reply.
pub fn carry_out(port: &mut dyn Port, request: &Request, hear: impl FnOnce(Reply<'_>)) -> Result<(), PortError> {
    let answer = match request {
        Request::Send { id, data } => port.send(*id, data).map(|()| None),
        Request::SetFeature { id, data } => port.set_feature(*id, data).map(|()| None),
        Request::GetFeature { id, bytes } => port.get_feature(*id, *bytes).map(Some),
    };
    match answer {
        Ok(None) => hear(Reply::Done),
        Ok(Some(data)) => hear(Reply::Feature(&data)),
        Err(PortError::Refused { .. }) => hear(Reply::Failed),
        Err(PortError::Gone) => {
            hear(Reply::Failed);
            return Err(PortError::Gone);
        }
    }
    Ok(())
}
