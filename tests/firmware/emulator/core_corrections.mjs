// SPDX-License-Identifier: Apache-2.0
// What rp2040js 1.4.1 gets wrong of the Cortex-M0+ (ARMv6-M: its architecture's manual), put right on one chip.

/**
 * Fault: an interrupt is pending exactly while its line is high, and one pended by software (below 26) never
 * ends. ARMv6-M B3.4.1: a rising line or ISPR latches the state; entering the handler clears it; a line still
 * high at the return pends it again; ICPR clears it unless the line is high.
 */
export function correctNvic({ core, ppb }) {
  const kIspr = 0x200, kIcpr = 0x280;
  let lines = 0;
  const pend = (bits) => {
    core.pendingInterrupts |= bits;
    core.interruptsUpdated = true;
    if (core.waiting && core.checkForInterrupts()) core.waiting = false;
  };
  core.setInterrupt = (irq, high) => {
    const bit = 1 << irq;
    const rises = high && !(lines & bit);
    lines = high ? lines | bit : lines & ~bit;
    if (rises) pend(bit);
  };
  const enter = core.exceptionEntry.bind(core);
  core.exceptionEntry = (number) => {
    if (number >= 16) core.pendingInterrupts &= ~(1 << (number - 16));
    enter(number);
  };
  const leave = core.exceptionReturn.bind(core);
  core.exceptionReturn = (code) => {
    const number = core.IPSR;
    leave(code);
    if (number >= 16) core.pendingInterrupts |= lines & (1 << (number - 16));
  };
  const write = ppb.writeUint32.bind(ppb);
  ppb.writeUint32 = (offset, value) => {
    if (offset === kIspr) pend(value);
    else if (offset === kIcpr) core.pendingInterrupts &= ~value | lines;
    else write(offset, value);
  };
}

/** True if something that is enabled waits to be taken, whatever PRIMASK says. */
function hasWork(core) {
  const interrupts = core.pendingInterrupts & core.enabledInterrupts;
  return Boolean(interrupts || core.pendingSystick || core.pendingPendSV || core.pendingNMI);
}

/**
 * Fault: WFI with PRIMASK set enters the handler on waking. ARMv6-M B1.5.17: it wakes, and the handler runs
 * when PRIMASK is cleared.
 */
export function correctSleep({ core }) {
  const check = core.checkForInterrupts.bind(core);
  core.checkForInterrupts = () => (core.waiting && core.PM ? hasWork(core) : check());
}

/**
 * Faults: SysTick does not end WFI; its period is RVR cycles, not RVR + 1; writing CVR while it is to count
 * pends the exception at once. ARMv6-M B3.3.1, B3.3.3.
 */
export function correctSystick(chip) {
  const kCsr = 0x10, kCvr = 0x18;
  const { core, ppb } = chip;
  const timer = ppb.systickTimer;
  let cleared = true;
  ppb.systickAlarm.callback = () => {
    ppb.systickCountFlag = true;
    timer.set(Math.min(ppb.systickReload + 1, 0xffffff));
    if (!ppb.systickIntEnable) return;
    core.pendingSystick = true;
    core.interruptsUpdated = true;
    if (core.waiting && core.checkForInterrupts()) core.waiting = false;
  };
  const write = ppb.writeUint32.bind(ppb);
  ppb.writeUint32 = (offset, value) => {
    if (offset === kCvr) {
      cleared = true;
      ppb.systickCountFlag = false;
    }
    const runs = offset === kCsr ? value & 1 : timer.enable;
    if (cleared && runs && (offset === kCsr || offset === kCvr)) {
      cleared = false;
      timer.set(Math.min(ppb.systickReload + 1, 0xffffff));
    }
    if (offset !== kCvr) write(offset, value);
  };
  const read = ppb.readUint32.bind(ppb);
  ppb.readUint32 = (offset) => {
    if (offset !== kCvr) return read(offset);
    return cleared ? 0 : Math.min(timer.counter, ppb.systickReload);
  };
}
