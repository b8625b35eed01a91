"""A client of saker-ground: the Foxglove WebSocket protocol as its specification has it, by Debian's python3-websockets."""

import asyncio
import json
import struct

import websockets

V1, SDK = "foxglove.websocket.v1", "foxglove.sdk.v1"


class Client:
    """async with Client(address) as client: greeted, knows channels and services."""

    def __init__(self, address, protocol=V1, **options):
        self.address, self.protocol, self.options = address, protocol, options
        self.channels, self.services, self.info, self.statuses = {}, {}, None, []
        self.topics, self.messages, self.answers, self.calls = {}, [], {}, 0

    async def __aenter__(self):
        self.socket = await websockets.connect(self.address, subprotocols=[self.protocol], max_size=None,
                                               compression=None, **self.options)
        while not self.services:
            self.take(await asyncio.wait_for(self.socket.recv(), 5))
        return self

    async def __aexit__(self, *_):
        await self.socket.close()

    def take(self, message):
        if isinstance(message, str):
            said = json.loads(message)
            if said["op"] == "serverInfo":
                self.info = said
            elif said["op"] == "advertise":
                self.channels.update({c["topic"]: c for c in said["channels"]})
            elif said["op"] == "advertiseServices":
                self.services.update({s["name"]: s for s in said["services"]})
            elif said["op"] == "serviceCallFailure":
                self.answers[said["callId"]] = RuntimeError(said["message"])
            else:
                self.statuses.append(said)
        elif message[0] == 1:
            subscription, time = struct.unpack_from("<IQ", message, 1)
            self.messages.append((self.topics[subscription], time, json.loads(message[13:])))
        elif message[0] == 3:
            _, call, size = struct.unpack_from("<III", message, 1)
            self.answers[call] = json.loads(message[13 + size:])

    async def subscribe(self, *topics):
        await self.until(lambda: all(topic in self.channels for topic in topics))
        first = len(self.topics)
        self.topics.update({first + i: topic for i, topic in enumerate(topics)})
        await self.socket.send(json.dumps({"op": "subscribe", "subscriptions": [
            {"id": first + i, "channelId": self.channels[topic]["id"]} for i, topic in enumerate(topics)]}))

    async def until(self, done, seconds=10):
        """Hears until it is so; whatever it is."""
        end = asyncio.get_event_loop().time() + seconds
        while not done():
            left = end - asyncio.get_event_loop().time()
            if left <= 0:
                raise AssertionError(f"not within {seconds} s; {len(self.messages)} messages, {self.statuses}")
            try:
                self.take(await asyncio.wait_for(self.socket.recv(), left))
            except asyncio.TimeoutError:
                pass

    async def drain(self):
        """Takes what comes and looks at none of it, until it is cancelled."""
        while True:
            await self.socket.recv()

    async def newest(self, topic, so=lambda message: True, seconds=10):
        """The newest message of a topic that is so."""
        await self.until(lambda: any(t == topic and so(m) for t, _, m in self.messages), seconds)
        return [m for t, _, m in self.messages if t == topic and so(m)][-1]

    async def call(self, service, request, seconds=10):
        self.calls += 1
        number = self.calls
        head = struct.pack("<BIII", 2, self.services[service]["id"], number, 4)
        await self.socket.send(head + b"json" + json.dumps(request).encode())
        await self.until(lambda: number in self.answers, seconds)
        answer = self.answers.pop(number)
        if isinstance(answer, Exception):
            raise answer
        return answer
