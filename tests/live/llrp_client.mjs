// SPDX-License-Identifier: Apache-2.0
// Tests our LLRP reader with llrpjs, an independent LLRP client and codec:
//
//   node llrp_client.mjs PACKAGES PORT
//
// Runs a typical client session, decodes each message with llrpjs, and prints the results as JSON.
import { createRequire } from "node:module";

const [packages, port] = process.argv.slice(2);
const { LLRPClient, LLRPCore } = createRequire(packages + "/")("llrpjs");
const reader = new LLRPClient({ host: "127.0.0.1", port: Number(port) });
const found = { reports: [], events: [], answers: {} };

const listed = (value) => (value === undefined ? [] : Array.isArray(value) ? value : [value]);

reader.on("RO_ACCESS_REPORT", (message) => {
  for (const tag of listed(message.toLLRPData().data.TagReportData)) found.reports.push(tag);
});
reader.on("READER_EVENT_NOTIFICATION", (message) =>
  found.events.push(message.toLLRPData().data.ReaderEventNotificationData));
reader.on("error", (error) => {
  console.error(String(error));
  process.exit(1);
});

// Not with transact(), which mistakes the next message that arrives for the response.
async function ask(name, data) {
  const answered = new Promise((done) => reader.once(`${name}_RESPONSE`, done));
  await reader.send(new LLRPCore[name](data === undefined ? {} : { data }));
  const answer = await answered;
  found.answers[name] = { type: answer.getName(), data: answer.toLLRPData().data };
}

const roSpec = {
  ROSpecID: 7, Priority: 1, CurrentState: "Disabled",
  ROBoundarySpec: {
    ROSpecStartTrigger: { ROSpecStartTriggerType: "Null" },
    ROSpecStopTrigger: { ROSpecStopTriggerType: "Null", DurationTriggerValue: 0 },
  },
  AISpec: {
    AntennaIDs: [1, 3],
    AISpecStopTrigger: { AISpecStopTriggerType: "Null", DurationTrigger: 0 },
    InventoryParameterSpec: {
      InventoryParameterSpecID: 1234, ProtocolID: "EPCGlobalClass1Gen2",
      AntennaConfiguration: {
        AntennaID: 0,
        RFTransmitter: { HopTableID: 1, ChannelIndex: 0, TransmitPower: 60 },
        C1G2InventoryCommand: {
          TagInventoryStateAware: false,
          C1G2RFControl: { ModeIndex: 2, Tari: 0 },
          C1G2SingulationControl: { Session: 1, TagPopulation: 32, TagTransitTime: 0 },
        },
      },
    },
  },
  ROReportSpec: {
    ROReportTrigger: "Upon_N_Tags_Or_End_Of_ROSpec", N: 1,
    TagReportContentSelector: {
      EnableROSpecID: true, EnableSpecIndex: true, EnableInventoryParameterSpecID: true,
      EnableAntennaID: true, EnableChannelIndex: true, EnablePeakRSSI: true,
      EnableFirstSeenTimestamp: true, EnableLastSeenTimestamp: true, EnableTagSeenCount: true,
      EnableAccessSpecID: true,
      C1G2EPCMemorySelector: { EnableCRC: true, EnablePCBits: true },
    },
  },
};

const events = ["ROSpec_Event", "AISpec_Event", "Antenna_Event"].map((EventType) => ({
  EventType, NotificationState: true,
}));

await reader.connect();
await reader.recv(7000); // the event that the reader has accepted the connection
await ask("GET_READER_CAPABILITIES", { RequestedData: "All" });
await ask("SET_READER_CONFIG", {
  ResetToFactoryDefault: true,
  ReaderEventNotificationSpec: { EventNotificationState: events },
  KeepaliveSpec: { KeepaliveTriggerType: "Periodic", PeriodicTriggerValue: 50 },
});
await ask("GET_READER_CONFIG", { AntennaID: 0, RequestedData: "All", GPIPortNum: 0, GPOPortNum: 0 });
await ask("DELETE_ROSPEC", { ROSpecID: 0 });
await ask("ADD_ROSPEC", { ROSpec: roSpec });
await ask("ENABLE_ROSPEC", { ROSpecID: 7 });
await ask("START_ROSPEC", { ROSpecID: 7 });
await ask("GET_ROSPECS");
while (found.reports.length < 100) await new Promise((done) => setTimeout(done, 50));
await ask("STOP_ROSPEC", { ROSpecID: 7 });
await ask("DISABLE_ROSPEC", { ROSpecID: 7 });
await ask("GET_ACCESSSPECS");
// llrpjs handles one message each time data arrives: keepalives make it reach the last one.
await new Promise((done) => setTimeout(done, 1500));
const gone = new Promise((done) => reader.once("disconnect", done));
await Promise.race([ask("CLOSE_CONNECTION"), gone]);
process.stdout.write(JSON.stringify(found), () => process.exit(0));
