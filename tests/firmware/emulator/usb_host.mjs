// SPDX-License-Identifier: Apache-2.0
// A strict full-speed USB host on rp2040js's register model: it moves data only when it wants to, and reports
// every mistake that a real host or the real controller would punish.

const kAvailable = 1 << 10, kStall = 1 << 11, kData1 = 1 << 13, kFull = 1 << 15, kLength = 0x3ff;
const kEndpointEnable = 0x80000000, kDoubleBuffered = 0x40000000;
const kPullUp = 1 << 16; // SIE_CTRL
const kConnected = 1 << 16, kSuspended = 1 << 4; // SIE_STATUS
const kMaxPacket = 64;
const kResetRecoveryNanos = 10e6; // USB 2.0 sec. 7.1.7.5
const kTransactionNanos = 50e3; // a 64-byte transaction and its turn on the bus
const kFrameNanos = 1e6;
const kHangingNanos = 800e3; // of a frame; what is sent after it can hang the controller (RP2040-E15)
const kAvailableDelayCycles = 6; // clk_sys cycles that AVAILABLE must follow the rest by: 2 of clk_usb

const bufferControl = (endpoint, isIn) => 0x80 + 8 * endpoint + (isIn ? 0 : 4);
const endpointControl = (endpoint, isIn) => 8 * endpoint + (isIn ? 0 : 4);
const key = (endpoint, isIn) => endpoint | (isIn ? 0x80 : 0);
const nameOf = (endpoint, isIn) => `endpoint ${endpoint} ${isIn ? 'IN' : 'OUT'}`;

/**
 * One transaction that the host wants: `done` gets {status: 'ok' | 'stall' | 'cancelled', data}.
 * @typedef {{endpoint: number, isIn: boolean, data: Uint8Array | null, done: (result: object) => void}} Transaction
 */
export class UsbHost {
  /**
   * @param {import('./rp2040.mjs').Emulator} emulator whose present chip is on the bus
   * @param {{onAttach?: () => void, onDetach?: () => void}} [events] attach: after the bus reset is handled
   */
  constructor(emulator, { onAttach = () => {}, onDetach = () => {} } = {}) {
    this.emulator = emulator;
    this.chip = emulator.mcu;
    this.controller = this.chip.usbCtrl;
    this.queues = new Map();
    this.toggles = new Map();
    this.address = 0;
    this.plugged = true;
    this.attached = false;
    this.written = new Map(); // buffer control offset -> {value, cycles} of the last write without AVAILABLE
    this.onAttach = onAttach;
    this.onDetach = onDetach;
    this.frames = new Frames(this.chip);
    this.alarm = this.chip.clock.createAlarm(() => this.#poll());
    this.recovery = this.chip.clock.createAlarm(() => {
      this.attached = true;
      this.frames.start();
      this.onAttach();
    });
    this.#takeOver();
  }

  /** Queues a transaction; tokens are repeated until the device is ready, as after NAKs. */
  transfer(endpoint, isIn, data, done) {
    const transaction = { endpoint, isIn, data, done };
    this.#queue(endpoint, isIn).push(transaction);
    this.#schedule();
    return transaction;
  }

  /** Gives up a queued transaction; false if it is over. */
  cancel(transaction) {
    const queue = this.#queue(transaction.endpoint, transaction.isIn);
    const index = queue.indexOf(transaction);
    if (index >= 0) queue.splice(index, 1);
    return index >= 0;
  }

  /** Sends a SETUP packet; it ends whatever endpoint 0 was doing (USB 2.0 sec. 8.5.3). */
  setup(packet) {
    this.#checkAddress();
    for (const isIn of [true, false]) {
      for (const { done } of this.#queue(0, isIn).splice(0)) done({ status: 'cancelled' });
      this.toggles.set(key(0, isIn), 1);
      const offset = bufferControl(0, isIn);
      this.#write(offset, this.#read(offset) & ~(kAvailable | kStall));
    }
    this.controller.epStallArm = 0;
    this.controller.sendSetupPacket(packet);
  }

  /** Starts an endpoint over with DATA0 (USB 2.0 sec. 9.4.5, 9.1.1.5). */
  resetToggles(endpoints = [...this.toggles.keys()].filter((each) => each & 0x0f)) {
    for (const each of endpoints) this.toggles.set(each, 0);
  }

  /** Pulls the plug: VBUS goes, the device sees the disconnection. */
  unplug() {
    this.plugged = false;
    this.frames.stop();
    this.controller.sieStatus = (this.controller.sieStatus & ~kConnected) | kSuspended;
    this.controller.sieStatusUpdated();
    this.#detach();
  }

  suspend() {
    this.frames.stop();
    this.controller.sieStatus |= kSuspended;
    this.controller.sieStatusUpdated();
  }

  resume() {
    this.controller.sieStatus &= ~kSuspended;
    this.controller.sieStatusUpdated();
    this.frames.start();
  }

  /** A bus reset that does not end: SE0, without frames, which is not suspended either. */
  holdReset() {
    this.frames.stop();
    this.plugged = false; // so that nobody attaches after it
    this.controller.resetDevice();
  }

  /** Puts the plug back; a device with its pull-up on is reset and attaches. */
  plug() {
    this.plugged = true;
    this.controller.sieStatus &= ~kSuspended;
    this.controller.sieStatusUpdated();
    if (this.controller.sieCtrl & kPullUp) this.controller.resetDevice();
  }

  /** Resets the bus, as hosts do before they enumerate; `onAttach` is called once more when it is over. */
  reset() {
    this.#cancelAll();
    this.attached = false;
    this.controller.resetDevice();
  }

  #takeOver() {
    const { controller } = this;
    controller.onUSBEnabled = undefined;
    controller.onEndpointRead = undefined;
    controller.onEndpointWrite = undefined;
    controller.onResetReceived = () => {
      if (this.plugged && !this.attached) this.recovery.schedule(kResetRecoveryNanos);
    };
    const handle = controller.handleSieCtrlWrite.bind(controller);
    controller.handleSieCtrlWrite = (value) => {
      const before = controller.sieCtrl & kPullUp;
      handle(value);
      if (!before && value & kPullUp) this.#connect();
      if (before && !(value & kPullUp)) this.#detach();
    };
    controller.DPRAMUpdated = (offset, value) => this.#bufferControlWritten(offset, value);
    if (controller.sieCtrl & kPullUp) this.#connect();
  }

  #connect() {
    if (!(this.controller.mainCtrl & 1)) this.#report('pull-up on while MAIN_CTRL.CONTROLLER_EN = 0');
    if (!(this.controller.sieStatus & 1)) this.#report('pull-up on without VBUS detected (USB_PWR override)');
    if (this.plugged) this.controller.resetDevice();
  }

  #cancelAll() {
    this.recovery.cancel();
    for (const queue of this.queues.values()) {
      for (const { done } of queue.splice(0)) done({ status: 'cancelled' });
    }
    this.toggles.clear();
    this.address = 0;
  }

  #detach() {
    this.#cancelAll();
    if (this.attached) this.onDetach();
    this.attached = false;
  }

  #checkAddress() {
    const answers = this.controller.addrEndp & 0x7f;
    if (answers !== this.address) this.#report(`device answers address ${answers}, expected ${this.address}`);
  }

  #queue(endpoint, isIn) {
    const id = key(endpoint, isIn);
    if (!this.queues.has(id)) this.queues.set(id, []);
    return this.queues.get(id);
  }

  #read(offset) {
    return this.chip.usbDPRAMView.getUint32(offset, true);
  }

  #write(offset, value) {
    this.chip.usbDPRAMView.setUint32(offset, value, true);
  }

  #report(rule) {
    this.chip.report(`USB: ${rule}`);
  }

  #schedule(nanos = kTransactionNanos) {
    if (!this.alarm.scheduled) this.alarm.schedule(nanos);
  }

  #bufferControlWritten(offset, value) {
    if (offset < 0x80 || offset > 0xfc || offset & 3) return;
    const now = this.chip.core.cycles;
    if (!(value & kAvailable)) this.written.set(offset, { value, now });
    if (value & (kAvailable | kStall)) this.#schedule();
    if (!(value & kAvailable)) return;
    const before = this.written.get(offset);
    const settled = before && before.value === (value & ~kAvailable) && now - before.now >= kAvailableDelayCycles;
    const endpoint = (offset - 0x80) >> 3, isIn = !(offset & 4), name = nameOf(endpoint, isIn);
    if (!settled) this.#report(`${name} armed without writing the rest of its control first (sec. 4.1.2.5.1)`);
    if ((value & kLength) > kMaxPacket) this.#report(`${name} armed for ${value & kLength} bytes, at most 64`);
    if (isIn && !(value & kFull)) this.#report(`${name} armed without FULL`);
    if (!isIn && value & kFull) this.#report(`${name} armed with FULL`);
    if (endpoint > 0) this.#checkEndpoint(endpoint, isIn, name);
    if (endpoint > 0 && isIn && this.frames.phaseNanos >= kHangingNanos) {
      this.#report(`${name} armed in the last fifth of a frame (RP2040-E15)`);
    }
    const { clocks, pllUsb } = this.chip;
    if (!(clocks.usbCtrl & (1 << 11)) || pllUsb.frequency !== 48e6) this.#report('clk_usb is not an enabled 48 MHz');
  }

  #checkEndpoint(endpoint, isIn, name) {
    const control = this.#read(endpointControl(endpoint, isIn));
    if (!(control & kEndpointEnable)) this.#report(`${name} armed while its EP_CTRL.ENABLE = 0`);
    if (control & kDoubleBuffered) this.#report(`${name} is double buffered, which this host does not model`);
    if ((control & 0xffc0) < 0x180) this.#report(`${name} has its buffer at 0x${(control & 0xffc0).toString(16)}`);
  }

  /** One round over the bus: each endpoint with something queued gets one token. */
  #poll() {
    this.alarm.scheduled = false;
    let again = false;
    for (const queue of this.queues.values()) {
      if (queue.length === 0 || !this.attached) continue;
      const served = this.#token(queue);
      again ||= served && queue.length > 0;
    }
    if (again) this.#schedule();
  }

  #token(queue) {
    const { endpoint, isIn } = queue[0];
    const offset = bufferControl(endpoint, isIn), control = this.#read(offset);
    const armed = endpoint > 0 || this.controller.epStallArm & (isIn ? 1 : 2);
    if (control & kStall && armed) {
      queue.shift().done({ status: 'stall' });
      return true;
    }
    if (control & kStall) this.#report('endpoint 0 stalled without EP_STALL_ARM');
    if (!(control & kAvailable)) return false; // NAK
    this.#checkAddress();
    const expected = this.toggles.get(key(endpoint, isIn)) ?? 0, found = control & kData1 ? 1 : 0;
    if (found !== expected) this.#report(`${nameOf(endpoint, isIn)} uses DATA${found}, expected DATA${expected}`);
    this.toggles.set(key(endpoint, isIn), expected ^ 1);
    const start = endpoint ? this.#read(endpointControl(endpoint, isIn)) & 0xffc0 : 0x100;
    const transaction = queue.shift();
    const data = isIn ? this.#receive(offset, control, start) : this.#send(offset, control, start, transaction);
    this.controller.indicateBufferReady(endpoint, !isIn);
    transaction.done({ status: 'ok', data });
    return true;
  }

  #receive(offset, control, start) {
    this.#write(offset, control & ~(kAvailable | kFull));
    return this.chip.usbDPRAM.slice(start, start + (control & kLength));
  }

  #send(offset, control, start, { endpoint, data }) {
    const room = control & kLength;
    if (data.length > room) this.#report(`${nameOf(endpoint, false)} armed for ${room} bytes, got ${data.length}`);
    const bytes = data.subarray(0, room);
    this.chip.usbDPRAM.set(bytes, start);
    this.#write(offset, (control & ~(kAvailable | kLength)) | kFull | bytes.length);
    return bytes;
  }
}

/**
 * The frames that the host begins, one a millisecond, and what the device sees of them: SOF_RD and DEV_SOF (DS 4.1.4).
 * Their interrupt costs time in the emulator, so it comes only while the device has it enabled.
 */
class Frames {
  constructor(chip) {
    this.chip = chip;
    this.controller = chip.usbCtrl;
    this.firstNanos = null; // null while the bus is idle
    this.seen = 0; // frames, when SOF_RD was last read
    this.alarm = chip.clock.createAlarm(() => this.#look());
    this.#takeOver();
  }

  start() {
    this.firstNanos = this.chip.clock.nanos;
    this.seen = 0;
    this.#look();
  }

  stop() {
    this.firstNanos = null;
    this.alarm.cancel();
  }

  /** Time since the last frame began; 0 while there are none. */
  get phaseNanos() {
    return this.firstNanos === null ? 0 : (this.chip.clock.nanos - this.firstNanos) % kFrameNanos;
  }

  get #begun() {
    return this.firstNanos === null ? 0 : 1 + Math.floor((this.chip.clock.nanos - this.firstNanos) / kFrameNanos);
  }

  #takeOver() {
    const kSofRead = 0x48, kEnable = 0x90;
    const { controller } = this;
    const read = controller.readUint32.bind(controller);
    controller.readUint32 = (offset) => {
      if (offset !== kSofRead) return read(offset);
      this.seen = this.#begun;
      this.#look();
      return this.#begun & 0x7ff;
    };
    const write = controller.writeUint32.bind(controller);
    controller.writeUint32 = (offset, value) => {
      write(offset, value);
      if (offset === kEnable) this.#look();
    };
  }

  /** Raises the interrupt where a frame has begun that nobody has read, else waits for the next. */
  #look() {
    const kDeviceSof = 1 << 17;
    const { controller } = this;
    const unread = this.#begun > this.seen;
    controller.intRaw = unread ? controller.intRaw | kDeviceSof : controller.intRaw & ~kDeviceSof;
    controller.checkInterrupts();
    if (controller.intEnable & kDeviceSof && !unread && this.firstNanos !== null) {
      this.alarm.schedule(kFrameNanos - this.phaseNanos + 1);
    }
  }
}
