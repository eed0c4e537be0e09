// SPDX-License-Identifier: Apache-2.0
// Frames made here, read by npm's node-mavlink; and its frames of the same values, for us to read.
// Called by tests/mavlink/node_test.cpp: NODE_PATH=... node check.js CASES KEY_HEX
// CASES: a line of JSON each: {id, sequence, frame, signed, fields}, frames in hex, 64 bits as text.
// Prints a line each: "frame HEX", "signed HEX", "unknown ID", "wrong WHAT". Exit 3: no node-mavlink.
'use strict';
const fs = require('fs');
const { Readable } = require('stream');

let mavlink;
try {
    mavlink = require('node-mavlink');
} catch (error) {
    console.error(error.message);
    process.exit(3);
}

const kSystem = 1, kComponent = 191, kLink = 5;
const kTime_ms = Date.UTC(2027, 0, 1);
const registry = { ...mavlink.minimal.REGISTRY, ...mavlink.standard.REGISTRY, ...mavlink.common.REGISTRY };

function same(type, ours, theirs) {
    if (Array.isArray(ours)) {
        return ours.length === theirs.length && ours.every((one, i) => same(type, one, theirs[i]));
    }
    if (typeof theirs === 'bigint') {
        return BigInt(ours) === theirs;
    }
    return type.startsWith('float') ? Math.fround(ours) === theirs : ours === theirs;
}

function read(packet, one, clazz) {
    const wrong = [];
    if (packet.header.seq !== one.sequence || packet.header.sysid !== kSystem ||
        packet.header.compid !== kComponent || packet.header.msgid !== one.id) {
        wrong.push('header');
    }
    const data = packet.protocol.data(packet.payload, clazz);
    for (const field of clazz.FIELDS) {
        if (!(field.source in one.fields) || !same(field.type, one.fields[field.source], data[field.name])) {
            wrong.push(field.source);
        }
    }
    if (Object.keys(one.fields).length !== clazz.FIELDS.length) {
        wrong.push('number of fields');
    }
    return wrong;
}

function write(one, clazz, key) {
    const message = new clazz();
    for (const field of clazz.FIELDS) {
        const value = one.fields[field.source];
        message[field.name] = /^u?int64_t$/.test(field.type) ? BigInt(value) : value;
    }
    const plain = new mavlink.MavLinkProtocolV2(kSystem, kComponent).serialize(message, one.sequence);
    console.log('frame', plain.toString('hex'));
    const signer = new mavlink.MavLinkProtocolV2(kSystem, kComponent, mavlink.MavLinkProtocolV2.IFLAG_SIGNED);
    const signed = signer.sign(signer.serialize(message, one.sequence), kLink, key, kTime_ms);
    console.log('signed', signed.toString('hex'));
}

async function main([casesFile, keyHex]) {
    const key = Buffer.from(keyHex, 'hex');
    const cases = fs.readFileSync(casesFile, 'utf8').trim().split('\n').map((line) => JSON.parse(line));
    const known = cases.filter((one) => one.id in registry);
    for (const one of cases) {
        if (!(one.id in registry)) {
            console.log('unknown', one.id);
        }
    }
    // As one stream through its splitter, which checks the checksums.
    const bytes = Buffer.concat(known.map((one) => Buffer.from(one.frame + one.signed, 'hex')));
    const packets = [];
    for await (const packet of mavlink.createMavLinkStream(Readable.from([bytes]))) {
        packets.push(packet);
    }
    if (packets.length !== 2 * known.length) {
        console.log('wrong', `${packets.length} frames of ${2 * known.length} arrived`);
        return;
    }
    known.forEach((one, i) => {
        const clazz = registry[one.id];
        const [plain, signed] = [packets[2 * i], packets[2 * i + 1]];
        const wrong = [...read(plain, one, clazz), ...read(signed, one, clazz)];
        if (plain.signature !== null || signed.signature === null || !signed.signature.matches(key)) {
            wrong.push('signature');
        }
        if (wrong.length > 0) {
            console.log('wrong', clazz.MSG_NAME, wrong.join(' '));
        }
        write(one, clazz, key);
    });
}

main(process.argv.slice(2));
