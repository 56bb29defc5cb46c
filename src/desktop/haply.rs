//! Haply's service on this computer as a device.

use std::io::{self, ErrorKind};
use std::net::{SocketAddr, TcpStream};
use std::time::{Duration, Instant};

use tungstenite::{HandshakeError, Message, WebSocket, client};

use super::hid::OpenError;
use crate::haptics::haply::{ADDRESS, DESCRIPTOR, Translator};
use crate::haptics::port::{InputReport, Port, PortError};

/// How long it may take to answer, at first and ever after: it is on this computer. An arm that it tells nothing of for so
/// long is gone.
const PATIENCE: Duration = Duration::from_millis(500);
/// How long its end is waited for.
const LAST: Duration = Duration::from_millis(100);
/// Messages that are read at a time.
const AT_ONCE: usize = 64;

/// A line to the service.
pub(super) struct HaplyPort {
    socket: WebSocket<TcpStream>,
    translator: Translator,
    since: Instant,
    /// What was heard when the line was opened.
    first: Option<InputReport>,
    /// When the arm was last heard of, and how long it may be silent.
    heard: Instant,
    patience: Duration,
    /// Whether it was told something that it has not answered: it answers each message by one, and more than one under way
    /// would queue up, the end of a force behind them.
    is_owed: bool,
}

impl HaplyPort {
    /// Asks for the service, and for its arm.
    ///
    /// # Errors
    /// When it does not answer, or has no arm.
    pub(super) fn open() -> Result<Self, OpenError> {
        let address = ADDRESS.parse().map_err(|_| refused(ErrorKind::AddrNotAvailable.into()))?;
        Self::open_at(address, PATIENCE)
    }

    fn open_at(address: SocketAddr, patience: Duration) -> Result<Self, OpenError> {
        let socket = connect(address, patience).map_err(refused)?;
        let (translator, now) = (Translator::default(), Instant::now());
        let mut port = Self { socket, translator, since: now, first: None, heard: now, patience, is_owed: false };
        // It tells by itself once.
        while port.first.is_none() {
            match port.socket.read() {
                Ok(Message::Text(text)) => port.first = port.translator.hear(&text),
                Ok(_) => {}
                Err(_) => return Err(OpenError::HaplyArm),
            }
            if port.since.elapsed() > patience {
                return Err(OpenError::HaplyArm);
            }
        }
        port.socket.get_ref().set_nonblocking(true).map_err(refused)?;
        port.heard = Instant::now();
        Ok(port)
    }

    fn now_ms(&self) -> f64 {
        self.since.elapsed().as_secs_f64() * 1000.0
    }

    /// Tells the service the force of now, unless it has an answer to give first.
    fn tell(&mut self) -> Result<(), PortError> {
        match self.translator.say(self.now_ms()) {
            Some(text) if !self.is_owed => {
                self.is_owed = true;
                sent(self.socket.send(Message::text(text)))
            }
            _ => sent(self.socket.flush()),
        }
    }
}

fn refused(error: io::Error) -> OpenError {
    OpenError::Haply { address: ADDRESS, error }
}

fn connect(address: SocketAddr, patience: Duration) -> io::Result<WebSocket<TcpStream>> {
    let stream = TcpStream::connect_timeout(&address, patience)?;
    stream.set_nodelay(true)?;
    stream.set_read_timeout(Some(patience))?;
    stream.set_write_timeout(Some(patience))?;
    match client(format!("ws://{address}/"), stream) {
        Ok((socket, _)) => Ok(socket),
        Err(HandshakeError::Interrupted(_)) => Err(ErrorKind::TimedOut.into()),
        Err(HandshakeError::Failure(error)) => Err(io::Error::other(error)),
    }
}

/// What there was no room for stays with the socket, and goes with the next.
fn sent(result: Result<(), tungstenite::Error>) -> Result<(), PortError> {
    match result {
        Err(tungstenite::Error::Io(error)) if error.kind() == ErrorKind::WouldBlock => Ok(()),
        result => result.map_err(|_| PortError::Gone),
    }
}

impl Port for HaplyPort {
    fn descriptor(&self) -> &[u8] {
        DESCRIPTOR
    }

    fn send(&mut self, id: u8, data: &[u8]) -> Result<(), PortError> {
        if !self.translator.feel(self.now_ms(), id, data) {
            return Err(PortError::Refused { id, reason: "there is no such report".to_owned() });
        }
        self.tell()
    }

    fn set_feature(&mut self, id: u8, _data: &[u8]) -> Result<(), PortError> {
        Err(PortError::Refused { id, reason: "there are no feature reports".to_owned() })
    }

    fn get_feature(&mut self, id: u8, _bytes: usize) -> Result<Vec<u8>, PortError> {
        Err(PortError::Refused { id, reason: "there are no feature reports".to_owned() })
    }

    fn poll(&mut self) -> Result<Option<InputReport>, PortError> {
        if let Some(first) = self.first.take() {
            self.tell()?;
            return Ok(Some(first));
        }
        for _ in 0..AT_ONCE {
            let text = match self.socket.read() {
                Ok(Message::Text(text)) => text,
                Ok(Message::Close(_)) => return Err(PortError::Gone),
                // Pings are answered by the socket itself.
                Ok(_) => continue,
                Err(tungstenite::Error::Io(error)) if error.kind() == ErrorKind::WouldBlock => break,
                Err(_) => return Err(PortError::Gone),
            };
            self.is_owed = false;
            let report = self.translator.hear(&text);
            self.tell()?;
            if report.is_some() {
                self.heard = Instant::now();
                return Ok(report);
            }
        }
        if self.heard.elapsed() > self.patience { Err(PortError::Gone) } else { Ok(None) }
    }
}

impl Drop for HaplyPort {
    fn drop(&mut self) {
        let stream = self.socket.get_ref();
        let waits = stream
            .set_nonblocking(false)
            .and_then(|()| stream.set_read_timeout(Some(LAST)))
            .and_then(|()| stream.set_write_timeout(Some(LAST)));
        let Some(text) = self.translator.farewell().filter(|_| waits.is_ok()) else { return };
        // A service that is gone has no force to end.
        if self.socket.send(Message::text(text)).is_ok() && self.socket.close(None).is_ok() {
            // What lies unread would reset the line before the service has read the last.
            let until = Instant::now() + LAST;
            while Instant::now() < until && self.socket.read().is_ok() {}
        }
    }
}

#[cfg(test)]
mod tests {
    use std::net::TcpListener;
    use std::sync::mpsc::{Receiver, channel};
    use std::thread;

    use super::*;
    use crate::haptics::haply::{MAX_N, WATCHDOG_MS, id};

    /// More than a busy machine keeps a thread waiting.
    const LONG: Duration = Duration::from_secs(20);

    /// A service with an arm that moves by a mm with each answer, of which it gives one to each message; the forces along x
    /// come out. It ends with its client, or after so many.
    fn service(most: usize) -> (SocketAddr, Receiver<f64>) {
        serve(move |step| (step < most).then(|| state(step as f64 / 1000.0)))
    }

    fn state(x: f64) -> String {
        format!(r#"{{"inverse3":[{{"device_id":"0A1B","state":{{"cursor_position":{{"x":{x},"y":0,"z":0}}}}}}]}}"#)
    }

    /// What it tells at first and in each answer, as `telling` has it; it ends with the first `None`.
    fn serve(telling: impl Fn(usize) -> Option<String> + Send + 'static) -> (SocketAddr, Receiver<f64>) {
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let address = listener.local_addr().unwrap();
        let (forces, told) = channel();
        thread::spawn(move || {
            let mut socket = tungstenite::accept(listener.accept().unwrap().0).unwrap();
            for text in (0..).map_while(telling) {
                if socket.send(Message::text(text)).is_err() {
                    return;
                }
                let Ok(Message::Text(text)) = socket.read() else { return };
                let said: serde_json::Value = serde_json::from_str(&text).unwrap();
                let force = &said["inverse3"][0]["commands"]["set_cursor_force"]["vector"]["x"];
                if forces.send(force.as_f64().unwrap()).is_err() {
                    return;
                }
            }
        });
        (address, told)
    }

    /// The next report.
    fn report(port: &mut HaplyPort) -> Result<InputReport, PortError> {
        loop {
            if let Some(report) = port.poll()? {
                return Ok(report);
            }
            thread::sleep(Duration::from_millis(1));
        }
    }

    #[test]
    fn the_arm_moves_and_feels_and_is_let_go() {
        let (address, told) = service(usize::MAX);
        let mut port = HaplyPort::open_at(address, LONG).unwrap();
        let place = |report: &InputReport| i16::from_le_bytes([report.data[1], report.data[2]]);
        let first = place(&report(&mut port).unwrap());
        assert_eq!(told.recv().unwrap(), 0.0, "no force before one is asked for");
        assert!(place(&report(&mut port).unwrap()) > first);
        let force: Vec<u8> = [i16::MAX, 0, 0].into_iter().flat_map(i16::to_le_bytes).collect();
        port.send(id::FORCE, &force).unwrap();
        let is_felt = (0..20).any(|_| {
            report(&mut port).unwrap();
            told.recv_timeout(LONG).unwrap() == MAX_N
        });
        assert!(is_felt);
        // Not told again, it ends, though the service is answered all along.
        thread::sleep(Duration::from_millis(WATCHDOG_MS as u64 + 10));
        let until_none = (0..100).position(|_| {
            report(&mut port).unwrap();
            told.try_iter().last() == Some(0.0)
        });
        assert!(until_none.is_some());
        port.send(id::FORCE, &force).unwrap();
        drop(port);
        assert_eq!(told.iter().last(), Some(0.0), "the last that it hears");
    }

    #[test]
    fn one_message_is_under_way_however_often_a_force_is_told() {
        let (address, told) = service(usize::MAX);
        let mut port = HaplyPort::open_at(address, LONG).unwrap();
        let force = |part: i16| [part, 0, 0].into_iter().flat_map(i16::to_le_bytes).collect::<Vec<u8>>();
        for part in 0..1000 {
            port.send(id::FORCE, &force(part)).unwrap();
        }
        // Nothing was read meanwhile, so that nothing was answered.
        assert_eq!(told.recv_timeout(LONG).unwrap(), 0.0, "the first of them");
        thread::sleep(Duration::from_millis(50));
        assert_eq!(told.try_iter().count(), 0);
        port.send(id::FORCE, &force(0)).unwrap();
        report(&mut port).unwrap();
        report(&mut port).unwrap();
        assert_eq!(told.recv().unwrap(), 0.0, "the next that it hears is the last that was told");
    }

    #[test]
    fn an_arm_that_is_not_there_or_not_told_of_any_more_is_gone() {
        let (none, _told) = serve(|_| Some(r#"{"inverse3": []}"#.to_owned()));
        assert!(matches!(HaplyPort::open_at(none, PATIENCE), Err(OpenError::HaplyArm)));
        // Its plug is pulled after the third answer; the service goes on.
        let (address, told) = serve(|step| Some(if step < 3 { state(0.0) } else { r#"{"inverse3": []}"#.to_owned() }));
        let mut port = HaplyPort::open_at(address, PATIENCE).unwrap();
        let gone = std::iter::repeat_with(|| report(&mut port)).find_map(Result::err);
        assert_eq!(gone, Some(PortError::Gone));
        assert!(told.try_iter().count() > 3);
    }

    #[test]
    fn a_service_that_ends_or_is_none_is_told() {
        let (address, told) = service(3);
        let mut port = HaplyPort::open_at(address, LONG).unwrap();
        assert_eq!((0..10).find_map(|_| report(&mut port).err()), Some(PortError::Gone));
        assert_eq!(told.iter().count(), 3);
        assert!(port.send(0x11, &[1]).is_err() && port.set_feature(1, &[]).is_err());
        let closed = TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap();
        assert!(HaplyPort::open_at(closed, LONG).is_err());
    }
}
