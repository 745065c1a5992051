// SPDX-License-Identifier: Apache-2.0
// An emulated board on a virtual machine's USB: what the machine's kernel asks goes over the strict USB host's bus.

import { control, identify, request } from '../../firmware/emulator/usb_control.mjs';
import { UsbHost } from '../../firmware/emulator/usb_host.mjs';
import { RedirSocket, Status, Type, describe } from './usb_redir.mjs';

const kPacketBytes = 64;
const kSetConfiguration = 9, kGetInterface = 10, kSetInterface = 11, kToInterface = 1, kFromInterface = 0x81;
const statusOf = ({ status }) => ({ ok: Status.ok, stall: Status.stall, cancelled: Status.cancelled })[status];

export class RedirectedBoard {
  /**
   * @param {import('../../firmware/emulator/rp2040.mjs').Emulator} emulator the board, followed through its resets
   * @param {string} path of the socket that QEMU listens on
   * @param {() => void} onClose the machine has ended
   */
  constructor(emulator, path, onClose) {
    this.emulator = emulator;
    this.connected = false; // the machine knows of the device
    this.configuration = 0;
    this.delayed = []; // packets that wait for the end of a bus reset
    this.transfers = new Map(); // endpoint address -> those that wait for it, the first of them on the bus
    this.socket = new RedirSocket(path, {
      onReady: () => this.#follow(),
      onPacket: (type, id, body) => {
        if (this.host.attached && this.identified) this.#take(type, id, body);
        else this.delayed.push([type, id, body]);
      },
      onClose,
    });
    const previous = emulator.onReset;
    emulator.onReset = (each) => {
      previous(each);
      if (this.host && each.mcu !== this.host.chip) {
        this.#disconnect();
        this.#follow();
      }
    };
  }

  #follow() {
    this.identified = false;
    this.host = new UsbHost(this.emulator, {
      onAttach: () => identify(this.host, (device) => {
        this.identified = true;
        if (!this.connected) this.#connect(device);
        for (const packet of this.delayed.splice(0)) this.#take(...packet);
      }),
      onDetach: () => this.#disconnect(),
    });
  }

  #connect(device) {
    const { interfaces, endpoints, connect } = describe(device);
    this.connected = true;
    this.socket.send(Type.interfaceInfo, 0, interfaces);
    this.socket.send(Type.endpointInfo, 0, endpoints);
    this.socket.send(Type.deviceConnect, 0, connect);
  }

  #disconnect() {
    this.identified = false;
    this.transfers.clear();
    this.delayed = [];
    if (this.connected) this.socket.send(Type.deviceDisconnect, 0, Buffer.alloc(0));
    this.connected = false;
  }

  #take(type, id, body) {
    switch (type) {
      case Type.reset:
        this.identified = false;
        this.transfers.clear();
        return this.host.reset();
      case Type.control:
        return this.#control(id, body);
      case Type.bulk:
        return this.#bulk(id, body);
      case Type.cancel:
        return this.#cancel(id);
      case Type.setConfiguration:
        return this.#standard(request(0, kSetConfiguration, body[0], 0, 0), (result) => {
          if (result.status === 'ok') this.configuration = body[0];
          this.socket.send(Type.configurationStatus, id, Buffer.of(statusOf(result), this.configuration));
        });
      case Type.getConfiguration:
        return this.socket.send(Type.configurationStatus, id, Buffer.of(Status.ok, this.configuration));
      case Type.setAlternate:
        return this.#standard(request(kToInterface, kSetInterface, body[1], body[0], 0), (result) =>
          this.socket.send(Type.alternateStatus, id, Buffer.of(statusOf(result), body[0], body[1])));
      case Type.getAlternate:
        return this.#standard(request(kFromInterface, kGetInterface, 0, body[0], 1), (result) =>
          this.socket.send(Type.alternateStatus, id, Buffer.of(statusOf(result), body[0], result.data[0] ?? 0)));
      case Type.startInterrupts:
      case Type.stopInterrupts: // the board has an endpoint for them, as its class demands, and never uses it
        return this.socket.send(Type.interruptsStatus, id, Buffer.of(Status.ok, body[0]));
      case Type.deviceDisconnectAck:
        return undefined;
      default:
        throw new Error(`found a packet of type ${type}, which no serial port gets`);
    }
  }

  #standard(packet, done) {
    control(this.host, packet, undefined, done);
  }

  /** Body: endpoint, request, its type, status, value, index, length (16 bits each), data. */
  #control(id, body) {
    const [, code, type] = body;
    const packet = request(type, code, body.readUInt16LE(4), body.readUInt16LE(6), body.readUInt16LE(8));
    const toDevice = !(type & 0x80);
    control(this.host, packet, toDevice ? body.subarray(10) : undefined, (result) => {
      const answer = Buffer.from(body.subarray(0, 10));
      answer[3] = statusOf(result);
      answer.writeUInt16LE(result.data.length, 8);
      this.socket.send(Type.control, id, Buffer.concat([answer, toDevice ? Buffer.alloc(0) : result.data]));
    });
  }

  /** Body: endpoint, status, length's low half, stream (32 bits), length's high half, data. */
  #bulk(id, body) {
    const length = body.readUInt16LE(2) + 65536 * body.readUInt16LE(8);
    const transfer = { id, head: Buffer.from(body.subarray(0, 10)), endpoint: body[0], length, done: 0, data: [] };
    transfer.toSend = body.subarray(10);
    const queue = this.transfers.get(transfer.endpoint) ?? [];
    this.transfers.set(transfer.endpoint, queue);
    queue.push(transfer);
    if (queue.length === 1) this.#continue(queue);
  }

  /** Moves the next packet of a queue's first transfer. */
  #continue(queue) {
    const [transfer] = queue;
    if (!transfer) return;
    const isIn = (transfer.endpoint & 0x80) !== 0;
    const packet = isIn ? null : transfer.toSend.subarray(transfer.done, transfer.done + kPacketBytes);
    transfer.onBus = this.host.transfer(transfer.endpoint & 0x0f, isIn, packet, (result) => {
      if (result.status === 'cancelled') return;
      const moved = result.data ?? [];
      transfer.done += moved.length;
      if (isIn) transfer.data.push(...moved);
      const more = result.status === 'ok' && moved.length === kPacketBytes && transfer.done < transfer.length;
      if (!more) this.#answer(queue.shift(), statusOf(result));
      this.#continue(queue);
    });
  }

  #answer({ id, head, done, data }, status) {
    head[1] = status;
    head.writeUInt16LE(done & 0xffff, 2);
    head.writeUInt16LE(done >>> 16, 8);
    this.socket.send(Type.bulk, id, Buffer.concat([head, Buffer.from(data)]));
  }

  #cancel(id) {
    for (const queue of this.transfers.values()) {
      const at = queue.findIndex((transfer) => transfer.id === id);
      if (at < 0) continue;
      const [transfer] = queue.splice(at, 1);
      if (transfer.onBus) this.host.cancel(transfer.onBus);
      this.#answer(transfer, Status.cancelled);
      if (at === 0) this.#continue(queue);
    }
  }
}
