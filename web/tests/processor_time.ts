/** Return the microseconds of the processor that something takes, however busy the machine is. */
export function processorTime(act: () => void): number {
    const start = process.cpuUsage();
    act();
    // the sum: the system only estimates how it divides into user and system
    const { user, system } = process.cpuUsage(start);
    return user + system;
}
