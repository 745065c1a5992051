// SPDX-License-Identifier: Apache-2.0
// Control transfers (USB 2.0 sec. 8.5.3) and enumeration (sec. 9.1.2) on the strict host.

const kDirectionIn = 0x80, kMaxPacket = 64;
const kClearFeature = 1, kSetAddress = 5, kGetDescriptor = 6, kSetConfiguration = 9, kSetInterface = 11;
const kDevice = 1, kConfiguration = 2, kString = 3;

/** A SETUP packet. */
export function request(type, code, value, index, length) {
  return Uint8Array.of(type, code, value & 0xff, value >> 8, index & 0xff, index >> 8, length & 0xff, length >> 8);
}

/**
 * Runs one control transfer; `done` gets {status, data}.
 * @param {import('./usb_host.mjs').UsbHost} host
 * @param {Uint8Array} packet SETUP
 * @param {Uint8Array} [out] data of an OUT transfer
 */
export function control(host, packet, out, done) {
  const length = packet[6] | (packet[7] << 8);
  const isIn = (packet[0] & kDirectionIn) !== 0;
  const fail = (result) => done({ status: result.status, data: new Uint8Array(0) });

  const statusIn = () => host.transfer(0, true, null, (result) => {
    if (result.status !== 'ok') return fail(result);
    if (result.data.length) host.chip.report('USB: status stage is not empty');
    settle(host, packet);
    done({ status: 'ok', data: out ?? new Uint8Array(0) });
  });
  const received = [];
  const readMore = () => host.transfer(0, true, null, (result) => {
    if (result.status !== 'ok') return fail(result);
    received.push(...result.data);
    if (received.length > length) host.chip.report('USB: control IN data longer than wLength');
    if (result.data.length === kMaxPacket && received.length < length) return readMore();
    host.toggles.set(0, 1);
    host.transfer(0, false, new Uint8Array(0), ({ status }) => done({ status, data: Uint8Array.from(received) }));
  });
  const writeMore = (offset) => host.transfer(0, false, out.subarray(offset, offset + kMaxPacket), (result) => {
    if (result.status !== 'ok') return fail(result);
    if (offset + kMaxPacket < length) return writeMore(offset + kMaxPacket);
    host.toggles.set(kDirectionIn, 1);
    statusIn();
  });

  host.setup(packet);
  if (length === 0) statusIn();
  else if (isIn) readMore();
  else writeMore(0);
}

/** What a request that succeeded changes on the host's side. */
function settle(host, [type, code, value, , index]) {
  if (type === 0 && code === kSetAddress) host.address = value;
  if (type === 0 && code === kSetConfiguration) host.resetToggles();
  // Interface 0, the control one, has the notification endpoint alone, which has sent nothing.
  if (type === 1 && code === kSetInterface && index === 1) host.resetToggles();
  if (type === 2 && code === kClearFeature) host.resetToggles([index]);
}

/** Reads a descriptor; a device that refuses it is at fault. */
function getDescriptor(host, kind, index, length, then) {
  const language = kind === kString && index > 0 ? 0x0409 : 0;
  const packet = request(kDirectionIn, kGetDescriptor, (kind << 8) | index, language, length);
  control(host, packet, undefined, (result) => {
    if (result.status === 'cancelled') return;
    if (result.status !== 'ok') host.chip.report(`USB: descriptor ${kind}.${index} refused`);
    else then(result.data);
  });
}

/** A standard request without data, and the time that a device may take to follow it. */
function set(host, code, value, then) {
  control(host, request(0, code, value, 0, 0), undefined, (result) => {
    if (result.status === 'stall') host.chip.report(`USB: standard request ${code} refused`);
    else if (result.status === 'ok') host.chip.clock.createAlarm(then).schedule(2e6); // USB 2.0 sec. 9.2.6.3
  });
}

/**
 * Begins an enumeration as Linux does: device descriptor, address, descriptors.
 * @param {(device: {device: Uint8Array, configuration: Uint8Array}) => void} done
 */
export function identify(host, done) {
  const get = (kind, length, then) => getDescriptor(host, kind, 0, length, then);
  get(kDevice, 64, () => set(host, kSetAddress, 7, () => get(kDevice, 18, (device) =>
    get(kConfiguration, 9, (head) => get(kConfiguration, head[2] | (head[3] << 8), (configuration) =>
      done({ device, configuration }))))));
}

/**
 * Enumerates to the end: then come the strings and configuration 1.
 * @param {(device: {device: Uint8Array, configuration: Uint8Array, strings: string[]}) => void} done
 */
export function enumerate(host, done) {
  const strings = [];
  const readStrings = (indices, then) => {
    if (indices.length === 0) return then();
    getDescriptor(host, kString, indices[0], 255, (data) => {
      strings[indices[0]] = Buffer.from(data.subarray(2)).toString('utf16le');
      readStrings(indices.slice(1), then);
    });
  };
  identify(host, ({ device, configuration }) => {
    readStrings([0, device[14], device[15], device[16]].filter((index, at) => at === 0 || index > 0), () =>
      set(host, kSetConfiguration, 1, () => done({ device, configuration, strings })));
  });
}
