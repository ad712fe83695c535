"""Reads a recording, with `pip install mcap mcap-ros2-support` and nothing of Halfstep's: python recording.py run.mcap"""

import sys
from collections import Counter

from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory

counts, angles = Counter(), []
with open(sys.argv[1], "rb") as stream:
    reader = make_reader(stream, decoder_factories=[DecoderFactory()])
    for attachment in reader.iter_attachments():
        print("attached", attachment.name, len(attachment.data))
    for _, channel, message, decoded in reader.iter_decoded_messages():
        counts[channel.topic] += 1
        if channel.topic == "/measurements":
            angles.append((decoded.tick, decoded.angles[4]))
for topic, count in sorted(counts.items()):
    print(topic, count)
tick, knee = max(angles)
print("last right knee angle", tick, knee.hex())
