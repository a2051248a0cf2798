"""The configuration files of alarms, of Automation Studio 4 and 6."""

from plcsim.library.mapp.configuration import Acknowledgement, AlarmMapping, Monitoring
from plcsim.project.automation_studio.alarms import read_alarms

CORE_6 = """<Configuration><Element ID="gAlarms" Type="mpalarmxcore">
  <Group ID="mapp.AlarmX.Core"><Group ID="Mapping">
    <Group ID="[0]"><Property ID="Alarm" Value="Jam" />
      <Selector ID="Action" Value="Reaction"><Property ID="Name" Value="Stop" /></Selector></Group>
    <Group ID="[1]"><Property ID="Alarm" Value="[2-4,9]" />
      <Selector ID="Action" Value="EscalateReaction"><Property ID="Name" Value="Horn" /></Selector>
    </Group>
    <Group ID="[2]"><Property ID="Alarm" Value="[bad]" />
      <Selector ID="Action" Value="Reaction"><Property ID="Name" Value="Never" /></Selector></Group>
    <Group ID="[3]"><Property ID="Alarm" Value="Door" />
      <Selector ID="Action" Value="None" /></Group>
  </Group></Group>
  <Group ID="mapp.AlarmX.List"><Group ID="[0]"><Property ID="List" Value="gList" /></Group></Group>
</Element></Configuration>"""

LIST_6 = """<Configuration><Element ID="gList" Type="mpalarmxlist">
  <Group ID="mapp.AlarmX.Core.Configuration">
    <Group ID="[0]"><Property ID="Name" Value="Jam" /><Property ID="Severity" Value="3" />
      <Selector ID="Behavior" Value="UserDefined">
        <Property ID="AutoReset" Value="FALSE" /><Property ID="Acknowledge" Value="0" />
        <Property ID="MultipleInstances" Value="TRUE" />
        <Property ID="ReactionWhilePending" Value="FALSE" /></Selector></Group>
    <Group ID="[1]"><Property ID="Name" Value="Off" /><Property ID="Disable" Value="TRUE" /></Group>
    <Group ID="[2]"><Property ID="Message" Value="nameless" /></Group>
    <Group ID="[3]"><Property ID="Name" Value="Lid" />
      <Selector ID="Behavior" Value="DiscreteValueMonitoring"><Group ID="Monitoring">
        <Property ID="MonitoredPV" Value="::gLid" />
        <Group ID="TriggerValues"><Property ID="[0]" Value="TRUE" />
          <Property ID="[1]" Value="7" /></Group></Group></Selector></Group>
    <Group ID="[4]"><Property ID="Name" Value="Slip" />
      <Selector ID="Behavior" Value="DeviationMonitoring"><Group ID="Monitoring">
        <Property ID="MonitoredPV" Value="::gIs" /><Property ID="SetpointPV" Value="::gSet" />
        <Selector ID="LowLimitEnable" Value="Static"><Property ID="Limit" Value="-2" /></Selector>
        <Selector ID="HighLimitEnable" Value="Dynamic"><Property ID="LimitPV" Value="::gMost" />
        </Selector></Group></Selector></Group>
  </Group>
</Element></Configuration>"""


def test_a_core_names_its_list_and_reactions_to_names_and_severities(write):
    folder = write(
        {
            "a.mpalarmxcore": CORE_6,
            "b.MpAlarmXList": LIST_6,
            "broken.mpalarmxcore": "<Conf",
            "other.mprecipexml": '<Configuration><Element ID="gRecipe" /></Configuration>',
        }
    )
    found = read_alarms(sorted(folder.iterdir())).cores
    assert list(found) == ["gAlarms"]
    core = found["gAlarms"]
    assert list(core.alarms) == ["Jam", "Lid", "Slip"]
    assert core.mappings == (
        AlarmMapping("Stop", "Jam"),
        AlarmMapping("Horn", severities=(range(2, 5), range(9, 10)), is_escalated=True),
    )
    jam = core.alarms["Jam"]
    assert [mapping.follows_from(jam) for mapping in core.mappings] == [True, True]
    assert [mapping.follows_from(core.alarms["Lid"]) for mapping in core.mappings] == [False, False]


def test_behavior_and_what_variables_are_looked_at(write):
    folder = write({"a.mpalarmxcore": CORE_6, "b.mpalarmxlist": LIST_6})
    alarms = read_alarms(sorted(folder.iterdir())).cores["gAlarms"].alarms
    jam = alarms["Jam"].behavior
    assert (jam.auto_reset, jam.acknowledgement) == (False, Acknowledgement.DISABLED)
    assert (jam.has_instances, jam.reacts_while_pending) == (True, False)
    assert alarms["Lid"].monitoring == Monitoring("::gLid", (1.0, 7.0))
    assert alarms["Slip"].monitoring == Monitoring(
        "::gIs", setpoint="::gSet", low="-2", high="::gMost"
    )
    assert alarms["Slip"].behavior.auto_reset is False
