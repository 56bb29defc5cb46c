//! The device on the USB: a human interface device with Lumen's descriptor, asked every ms, and beside it a serial port
//! (`serial`), each a function of its own of one composite device.
//!
//! Output reports come through their endpoint or as requests, whichever the host's system likes; features as requests. A
//! reset, a sleep or a host that is gone lets the motors go.

use embassy_executor::Spawner;
use embassy_rp::peripherals::USB;
use embassy_rp::usb::Driver;
use embassy_sync::blocking_mutex::raw::ThreadModeRawMutex;
use embassy_sync::signal::Signal;
use embassy_usb::class::hid::{
    HidBootProtocol, HidReader, HidReaderWriter, HidSubclass, HidWriter, ReportId, RequestHandler, State,
};
use embassy_usb::control::OutResponse;
use embassy_usb::{Builder, Config, Handler, UsbDevice};
use lumen_feeder::feeder::{DESCRIPTOR, USB_IDS};
use lumen_feeder::turn::Line;
use static_cell::{ConstStaticCell, StaticCell};

use crate::{DEVICE, serial};

/// The longest report with its id. A host may fill others up to it.
const LONGEST_OUT: usize = 15;
/// The longest input report with its id.
const LONGEST_IN: usize = 6;

/// The board's own.
pub(crate) type Bus = Driver<'static, USB>;

/// The newest input reports; what the host was too slow for is dropped.
static REPORTS: Signal<ThreadModeRawMutex, ([u8; 6], [u8; 2])> = Signal::new();

/// Has the state sent at the host's next question, and what plays if that has changed.
pub(crate) fn tell(state: [u8; 6], playing: [u8; 2]) {
    REPORTS.signal((state, playing));
    serial::tell(&state, playing);
}

/// Appears on the bus.
pub(crate) fn start(spawner: Spawner, driver: Bus) {
    static CONFIGURATION: ConstStaticCell<[u8; 160]> = ConstStaticCell::new([0; 160]);
    static OBJECTS: ConstStaticCell<[u8; 32]> = ConstStaticCell::new([0; 32]);
    static CONTROL: ConstStaticCell<[u8; 64]> = ConstStaticCell::new([0; 64]);
    static STATE: StaticCell<State<'static>> = StaticCell::new();
    static REQUESTS: ConstStaticCell<Reports> = ConstStaticCell::new(Reports);
    static EVENTS: ConstStaticCell<Events> = ConstStaticCell::new(Events);

    let mut config = Config::new(USB_IDS[0], USB_IDS[1]);
    config.manufacturer = Some("Lumen");
    config.product = Some("Lumen feeder");
    let mut builder = Builder::new(driver, config, CONFIGURATION.take(), OBJECTS.take(), &mut [], CONTROL.take());
    builder.handler(EVENTS.take());
    let hid = embassy_usb::class::hid::Config {
        report_descriptor: DESCRIPTOR,
        request_handler: Some(REQUESTS.take()),
        poll_ms: 1,
        max_packet_size: 64,
        hid_subclass: HidSubclass::No,
        hid_boot_protocol: HidBootProtocol::None,
    };
    let hid = HidReaderWriter::<_, LONGEST_OUT, LONGEST_IN>::new(&mut builder, STATE.init(State::new()), hid);
    let (reader, writer) = hid.split();
    serial::start(spawner, &mut builder);
    spawner.spawn(bus(builder.build()).expect("it is spawned once"));
    spawner.spawn(read(reader).expect("it is spawned once"));
    spawner.spawn(write(writer).expect("it is spawned once"));
}

#[embassy_executor::task]
async fn bus(mut device: UsbDevice<'static, Bus>) {
    device.run().await;
}

#[embassy_executor::task]
async fn read(reader: HidReader<'static, Bus, LONGEST_OUT>) {
    reader.run(true, &mut Reports).await;
}

#[embassy_executor::task]
async fn write(mut writer: HidWriter<'static, Bus, LONGEST_IN>) {
    let mut told = None;
    loop {
        writer.ready().await;
        let (state, playing) = REPORTS.wait().await;
        // A host that is gone hears all of it when it comes back.
        let mut sent = writer.write(&state).await;
        if sent.is_ok() && told != Some(playing) {
            sent = writer.write(&playing).await;
            told = Some(playing);
        }
        if sent.is_err() {
            told = None;
        }
    }
}

/// Reports to and from the device, each with its id before it.
struct Reports;

impl RequestHandler for Reports {
    fn get_report(&mut self, id: ReportId, buffer: &mut [u8]) -> Option<usize> {
        let mut answer = |report: &[u8]| {
            buffer.get_mut(..report.len())?.copy_from_slice(report);
            Some(report.len())
        };
        DEVICE.lock(|device| {
            let mut device = device.borrow_mut();
            let (state, playing) = (device.state(), device.playing());
            match id {
                ReportId::Feature(id) if device.hears(Line::Hid) => answer(&device.feature(id)?),
                ReportId::In(id) if id == state[0] => answer(&state),
                ReportId::In(id) if id == playing[0] => answer(&playing),
                ReportId::Feature(_) | ReportId::In(_) | ReportId::Out(_) => None,
            }
        })
    }

    fn set_report(&mut self, id: ReportId, report: &[u8]) -> OutResponse {
        let taken = DEVICE.lock(|device| {
            let mut device = device.borrow_mut();
            if !device.hears(Line::Hid) {
                return false;
            }
            match (id, report) {
                (ReportId::Out(id), [first, data @ ..]) if id == *first => device.take(id, data).is_ok(),
                (ReportId::Feature(id), [first, data @ ..]) if id == *first => device.take_feature(id, data).is_ok(),
                _ => false,
            }
        });
        if taken { OutResponse::Accepted } else { OutResponse::Rejected }
    }
}

/// What happens on the bus.
struct Events;

impl Events {
    fn release() {
        DEVICE.lock(|device| device.borrow_mut().release());
    }
}

impl Handler for Events {
    fn enabled(&mut self, _: bool) {
        Self::release();
    }

    fn reset(&mut self) {
        Self::release();
    }

    fn configured(&mut self, _: bool) {
        Self::release();
    }

    fn suspended(&mut self, _: bool) {
        Self::release();
    }
}
